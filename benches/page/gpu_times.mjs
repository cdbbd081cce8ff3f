// GPU times of the page's submits, by timestamps at the start and the end of each: how long a submit itself takes, whatever
// else the browser draws before the page hears of its end.

/** Most submits between two readings: a query set has at most 4096 queries. */
const MOST_SUBMITS = 2048;

/**
 * Measures every submit of pages that are opened from now on.
 * @param {import("playwright-core").BrowserContext} context
 */
export async function watchSubmits(context) {
  await context.addInitScript(watch, MOST_SUBMITS);
}

/**
 * The submits since the last reading, in order.
 * @returns {Promise<{name: string, ms: number}[]>} `name` is the label of the submit's last command encoder
 */
export function takeSubmits(tab) {
  return tab.evaluate(() => window.takeSubmits());
}

/** Runs in the page, before its scripts. */
function watch(mostSubmits) {
  // Empty tabs have no GPU.
  if (!("gpu" in navigator)) return;
  const queues = new Map();
  /** The label of the encoder of each command buffer. */
  const labels = new WeakMap();
  const replace = (type, method, make) => {
    const { prototype } = type;
    prototype[method] = make(prototype[method]);
  };
  replace(GPUAdapter, "requestDevice", (request) => async function (wanted) {
    const requiredFeatures = [...(wanted?.requiredFeatures ?? []), "timestamp-query"];
    const device = await request.call(this, { ...wanted, requiredFeatures });
    const querySet = device.createQuerySet({ type: "timestamp", count: 2 * mostSubmits });
    queues.set(device.queue, { device, querySet, names: [] });
    return device;
  });
  replace(GPUCommandEncoder, "finish", (finish) => function (...given) {
    const commands = finish.apply(this, given);
    labels.set(commands, this.label);
    return commands;
  });
  /** Commands of nothing but a timestamp. */
  const stamp = ({ device, querySet }, key, index) => {
    const encoder = device.createCommandEncoder();
    encoder.beginComputePass({ timestampWrites: { querySet, [key]: index } }).end();
    return encoder.finish();
  };
  const { submit } = GPUQueue.prototype;
  // The timestamps belong to the measured submit: between submits of their own and that one the page could be held up.
  replace(GPUQueue, "submit", () => function (given) {
    const commands = [...given];
    const watched = queues.get(this);
    if (!watched || commands.length === 0) return submit.call(this, commands);
    const index = 2 * watched.names.length;
    watched.names.push(labels.get(commands.at(-1)) ?? "");
    if (index >= 2 * mostSubmits) return submit.call(this, commands);
    const begin = stamp(watched, "beginningOfPassWriteIndex", index);
    return submit.call(this, [begin, ...commands, stamp(watched, "endOfPassWriteIndex", index + 1)]);
  });
  window.takeSubmits = async () => {
    const all = [];
    for (const [queue, watched] of queues) {
      const { device, querySet } = watched;
      const taken = watched.names.splice(0);
      if (taken.length === 0) continue;
      const lost = taken.length - mostSubmits;
      if (lost > 0) throw Error(`${lost} submits passed unmeasured: read more often`);
      const size = 16 * taken.length;
      const resolved = device.createBuffer({ size, usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC });
      const read = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
      const encoder = device.createCommandEncoder();
      encoder.resolveQuerySet(querySet, 0, 2 * taken.length, resolved, 0);
      encoder.copyBufferToBuffer(resolved, 0, read, 0, size);
      submit.call(queue, [encoder.finish()]);
      await read.mapAsync(GPUMapMode.READ);
      const times = new BigUint64Array(read.getMappedRange());
      taken.forEach((name, index) => {
        all.push({ name, ms: Number(times[2 * index + 1] - times[2 * index]) / 1e6 });
      });
      read.destroy();
      resolved.destroy();
    }
    return all;
  };
}

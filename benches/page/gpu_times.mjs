// GPU times of the page's submits, by timestamps around each: how long a submit itself takes, whatever else the browser
// draws before the page hears of its end.

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
  /** The queries of each encoder, and those and the label of what it recorded. */
  const encoders = new WeakMap();
  const recorded = new WeakMap();
  const replace = (type, method, make) => {
    const { prototype } = type;
    prototype[method] = make(prototype[method]);
  };
  replace(GPUAdapter, "requestDevice", (request) => async function (wanted) {
    const requiredFeatures = [...(wanted?.requiredFeatures ?? []), "timestamp-query"];
    const device = await request.call(this, { ...wanted, requiredFeatures });
    const querySet = device.createQuerySet({ type: "timestamp", count: 2 * mostSubmits });
    queues.set(device.queue, { device, querySet, encoders: 0, submits: [] });
    return device;
  });
  const createEncoder = GPUDevice.prototype.createCommandEncoder;
  const { submit } = GPUQueue.prototype;
  // The first and the last pass of the commands themselves write the times: in submits of their own, around the measured
  // one, they would also count whatever keeps the page from submitting it.
  const stamp = (encoder, { querySet }, key, index) => {
    encoder.beginComputePass({ timestampWrites: { querySet, [key]: index } }).end();
  };
  replace(GPUDevice, "createCommandEncoder", () => function (descriptor) {
    const encoder = createEncoder.call(this, descriptor);
    const watched = queues.get(this.queue);
    const first = 2 * watched.encoders;
    watched.encoders += 1;
    if (watched.encoders <= mostSubmits) {
      stamp(encoder, watched, "beginningOfPassWriteIndex", first);
      encoders.set(encoder, { watched, first });
    }
    return encoder;
  });
  replace(GPUCommandEncoder, "finish", (finish) => function (...given) {
    const stamped = encoders.get(this);
    if (stamped) stamp(this, stamped.watched, "endOfPassWriteIndex", stamped.first + 1);
    const commands = finish.apply(this, given);
    recorded.set(commands, { name: this.label, first: stamped?.first });
    return commands;
  });
  replace(GPUQueue, "submit", () => function (given) {
    const commands = [...given];
    if (commands.length > 0) {
      const [begin, end] = [recorded.get(commands[0]), recorded.get(commands.at(-1))];
      queues.get(this).submits.push({ name: end.name, begin: begin.first, end: end.first });
    }
    return submit.call(this, commands);
  });
  window.takeSubmits = async () => {
    const all = [];
    for (const [queue, watched] of queues) {
      const { device, querySet } = watched;
      const submits = watched.submits.splice(0);
      if (submits.length === 0) continue;
      if (watched.encoders > mostSubmits) throw Error(`of ${watched.encoders} encoders some were not measured: read more often`);
      const size = 16 * watched.encoders;
      // Encoders that were created and not yet submitted are those of the present frame: none between two frames.
      const queries = 2 * watched.encoders;
      watched.encoders = 0;
      const resolved = device.createBuffer({ size, usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC });
      const read = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
      const encoder = createEncoder.call(device);
      encoder.resolveQuerySet(querySet, 0, queries, resolved, 0);
      encoder.copyBufferToBuffer(resolved, 0, read, 0, size);
      submit.call(queue, [encoder.finish()]);
      await read.mapAsync(GPUMapMode.READ);
      const times = new BigUint64Array(read.getMappedRange());
      for (const { name, begin, end } of submits) {
        all.push({ name, ms: Number(times[end + 1] - times[begin]) / 1e6 });
      }
      read.destroy();
      resolved.destroy();
    }
    return all;
  };
}

//! Processor load of this program and of others, on systems with `/proc` (Linux).

/// Processor times since the machine started, in clock ticks.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    all: f64,
    idle: f64,
    own: f64,
}

impl Load {
    /// The current times; none where the system has no `/proc`.
    pub fn now() -> Option<Self> {
        let machine = std::fs::read_to_string("/proc/stat").ok()?;
        // "cpu", then user, nice, system, idle, waiting, interrupts, soft interrupts, stolen.
        let times = machine.lines().next()?.split_whitespace().skip(1).take(8);
        let times = times.map(|time| time.parse().ok()).collect::<Option<Vec<f64>>>()?;
        let process = std::fs::read_to_string("/proc/self/stat").ok()?;
        // The name, in parentheses, may contain anything. User and system time are the
        // 12th and 13th field after it.
        let fields: Vec<_> = process.rsplit(')').next()?.split_whitespace().collect();
        let own = |field: usize| fields.get(field)?.parse::<f64>().ok();
        Some(Self {
            all: times.iter().sum(),
            idle: times.get(3)? + times.get(4)?,
            own: own(11)? + own(12)?,
        })
    }

    /// Fraction of all processor time that other programs used since `before`.
    pub fn others_share_since(&self, before: &Self) -> f64 {
        let all = (self.all - before.all).max(1.0);
        ((all - (self.idle - before.idle) - (self.own - before.own)) / all).clamp(0.0, 1.0)
    }

    /// Fraction of all processor time that this program used since `before`.
    pub fn own_share_since(&self, before: &Self) -> f64 {
        ((self.own - before.own) / (self.all - before.all).max(1.0)).clamp(0.0, 1.0)
    }
}

//! What one kind of work has cost lately: robust estimates from its last measurements.
//!
//! In: the rays and the time of each piece. Out: a fixed cost, and the cost of a ray. Medians and
//! quantiles ignore single pieces that other programs held up, or that did work which is done once.

use std::collections::VecDeque;

use super::types::Phase;

/// Rays of the first piece of a kind, and of a view: few enough for a device 200 times slower than a desktop's.
pub const FIRST_RAYS: f64 = 4096.0;

/// Cost of a ray before anything is measured, milliseconds.
const ASSUMED_MS: f64 = 0.001;

/// Refining pieces that an estimate is made of. The median slope stays right while fewer than 29 %
/// of them are held up.
const REFINING_PIECES: usize = 32;

/// Those of other views that are kept at a jump: few, so that those of the new view soon outnumber them.
const PIECES_OF_OTHER_VIEWS: usize = 8;

/// Openings that an estimate is made of: the view changes from one to the next.
const OPENINGS: usize = 9;

/// Part of those openings that cost no more than the estimate: few pictures are late.
const OPENINGS_QUANTILE: f64 = 0.75;

/// How many times as many rays as before in this view a piece may have: two lattice levels and a margin.
const GROWTH: f64 = 5.0;

/// Growth from the largest of the last short pieces, where the fixed time alone is longer than a piece should be.
///
/// What seems fixed may be the time of one workgroup: several that run side by side take as long as one, so that rays
/// seem to cost nothing until there are more workgroups than that.
const CAREFUL_GROWTH: f64 = 2.0;

/// Pieces from which on those of a kind of work without openings grow as fast as others: the time of the first ones may be reported
/// as that of frames of the interface beside them.
const TRIED_PIECES: usize = 3;

/// The longest short piece, in fixed times.
const SHORT: f64 = 1.5;

/// Largest part of a piece's time that counts as fixed.
///
/// Below 1, so that pieces grow step by step.
const MAX_FIXED: f64 = 0.95;

/// Pieces that can show that nearly all of their time is fixed.
const MANY_PIECES: usize = 6;

/// Largest part of the time of fewer pieces, and of openings, that counts as fixed.
///
/// Two pieces of an expensive part of a picture can look alike whatever their sizes. A fixed cost found too high would
/// otherwise explain openings that are too dense, and no refining piece corrects it while a movement lasts.
const MAX_FIXED_OF_FEW: f64 = 0.5;

/// Two openings in a row that cost so many times what refining pieces predict show another view; one opening of a jump
/// shows a much more expensive one. Rays of a sparse lattice have little in common: up to twice the cost is normal.
const OTHER_VIEW: f64 = 3.0;

/// One piece of work.
#[derive(Clone, Copy, Debug)]
pub struct Measurement {
    /// Its rays, or its [parts](super::division).
    pub rays: f64,
    /// Its time, milliseconds.
    pub ms: f64,
}

impl Measurement {
    /// The time of an opening's rays beside a fixed time, milliseconds.
    fn rays_ms(&self, fixed_ms: f64) -> f64 {
        (self.ms - fixed_ms).max((1.0 - MAX_FIXED_OF_FEW) * self.ms)
    }
}

/// An estimate of what one kind of work costs.
#[derive(Clone, Copy, Debug)]
pub struct Rate {
    /// Time of a piece whatever its size, milliseconds.
    pub fixed_ms: f64,
    /// Time that each ray adds, milliseconds.
    pub ray_ms: f64,
    /// Most rays for which the estimate holds.
    pub max_rays: f64,
    /// Most rays where the fixed time alone is longer than a piece should be.
    careful_rays: f64,
}

impl Rate {
    /// The rate before anything is measured.
    pub const ASSUMED: Self =
        Self { fixed_ms: 0.0, ray_ms: ASSUMED_MS, max_rays: FIRST_RAYS, careful_rays: FIRST_RAYS };

    /// Estimated time of a piece of so many rays, milliseconds.
    pub fn expected_ms(&self, rays: f64) -> f64 {
        self.fixed_ms + self.ray_ms * rays
    }

    /// Most rays of the next piece, whose rays are to take `aim_ms`.
    ///
    /// The fixed time comes on top. If it is longer than `aim_ms`, the rays take as long as it does. The sizes of measured
    /// pieces limit both.
    pub fn rays(&self, aim_ms: f64) -> f64 {
        let limit = if self.fixed_ms > aim_ms { self.careful_rays } else { self.max_rays };
        (aim_ms.max(self.fixed_ms) / self.ray_ms).min(limit)
    }

    /// The same rate with rays that cost `factor` times as much.
    pub fn scaled(self, factor: f64) -> Self {
        Self { ray_ms: self.ray_ms * factor, ..self }
    }

    /// The same rate for a kind of work that has not been tried, whose samples are assumed to take as long as `factor` rays.
    pub fn untried(self, factor: f64) -> Self {
        let first = FIRST_RAYS / factor;
        Self { max_rays: first, careful_rays: first, ..self.scaled(factor) }
    }
}

/// What openings and refining pieces of one kind of work have cost lately.
#[derive(Clone, Debug, Default)]
pub struct CostHistory {
    pieces: VecDeque<Measurement>,
    openings: VecDeque<Measurement>,
    /// Rays of the largest piece in the present view.
    most_rays: f64,
    /// Measured over predicted time of the last two openings.
    excess: [f64; 2],
    refining: Option<Rate>,
    opening: Option<Rate>,
}

impl CostHistory {
    /// The rate of one phase; none before the first measurement.
    pub fn rate(&self, phase: Phase) -> Option<Rate> {
        match phase {
            Phase::Opening | Phase::Jump => self.opening.or(self.refining),
            Phase::Refining => self.refining.or(self.opening),
        }
    }

    /// The rate of openings; none where there were none.
    pub fn opening(&self) -> Option<Rate> {
        self.opening
    }

    /// Learns from a piece of work.
    pub fn learn(&mut self, phase: Phase, rays: f64, ms: f64) {
        let measurement = Measurement { rays, ms };
        match phase {
            Phase::Opening => self.learn_opening(measurement),
            Phase::Jump => {
                self.learn_jump(measurement);
                self.learn_opening(measurement);
            }
            Phase::Refining => {
                self.most_rays = self.most_rays.max(rays);
                push(&mut self.pieces, REFINING_PIECES, measurement);
                self.refining = self.line();
            }
        }
    }

    /// The rate of the refining pieces, which may grow from what was tried in this view.
    fn line(&self) -> Option<Rate> {
        let (fixed_ms, ray_ms) = line(&self.pieces)?;
        // A browser may report most of a piece's time as that of a frame of the interface beside it. Few pieces do not show that rays
        // cost much less than those of the openings did.
        let least_ms = match self.opening {
            Some(opening) if self.pieces.len() < MANY_PIECES => opening.ray_ms / OTHER_VIEW,
            _ => 0.0,
        };
        let ray_ms = ray_ms.max(least_ms);
        let short = self.pieces.iter().filter(|piece| piece.ms <= SHORT * fixed_ms);
        // Without a short piece rays cost enough for the estimate to hold.
        let short_rays = short.map(|piece| piece.rays).reduce(f64::max).unwrap_or(self.most_rays);
        let is_tried = self.opening.is_some() || self.pieces.len() >= TRIED_PIECES;
        let max_rays = if is_tried { GROWTH } else { CAREFUL_GROWTH } * self.most_rays;
        let careful_rays = max_rays.min(CAREFUL_GROWTH * short_rays);
        Some(Rate { fixed_ms, ray_ms, max_rays, careful_rays })
    }

    /// Forgets most of what other views cost, and all of it where the opening shows a much more expensive view: pieces
    /// sized by a cheap one could take seconds.
    fn learn_jump(&mut self, opening: Measurement) {
        self.most_rays = opening.rays;
        let Some(rate) = self.refining.or(self.opening) else { return };
        let expected_ms = rate.ray_ms * opening.rays;
        let kept = if opening.rays_ms(rate.fixed_ms) > OTHER_VIEW * expected_ms {
            self.openings.clear();
            0
        } else {
            PIECES_OF_OTHER_VIEWS
        };
        self.pieces.drain(..self.pieces.len().saturating_sub(kept));
        self.refining = self.line();
        self.excess = [0.0; 2];
    }

    fn learn_opening(&mut self, opening: Measurement) {
        if let Some(rate) = self.refining {
            self.excess = [self.excess[1], opening.ms / rate.expected_ms(opening.rays)];
        }
        // Pieces of a cheaper view would make those of this one too long.
        if self.excess.iter().all(|&excess| excess > OTHER_VIEW) {
            self.pieces.clear();
            self.refining = None;
            self.excess = [0.0; 2];
        }
        push(&mut self.openings, OPENINGS, opening);
        // Openings are too few, and of too many views, to separate their own fixed cost.
        let fixed_ms = self.refining.or(self.opening).map_or(0.0, |rate| rate.fixed_ms);
        let ray_ms = |opening: &Measurement| opening.rays_ms(fixed_ms) / opening.rays;
        self.opening =
            quantile(OPENINGS_QUANTILE, self.openings.iter().map(ray_ms).collect()).map(|ray_ms| {
                Rate {
                    fixed_ms,
                    ray_ms,
                    max_rays: GROWTH * opening.rays,
                    careful_rays: CAREFUL_GROWTH * opening.rays,
                }
            });
    }
}

/// Adds a measurement to the last `length` ones.
pub fn push(window: &mut VecDeque<Measurement>, length: usize, measurement: Measurement) {
    if window.len() == length {
        window.pop_front();
    }
    window.push_back(measurement);
}

/// The fixed time and the time of a ray: the line whose slope is the median of all pairs' slopes (Theil 1950, Sen 1968).
pub fn line(pieces: &VecDeque<Measurement>) -> Option<(f64, f64)> {
    let slopes = pieces.iter().enumerate().flat_map(|(index, a)| {
        let others = pieces.iter().take(index).filter(|b| b.rays != a.rays);
        others.map(|b| (a.ms - b.ms) / (a.rays - b.rays))
    });
    // Pieces of one size can't separate the two costs: all of theirs counts as rays'.
    let max_fixed = if pieces.len() < MANY_PIECES { MAX_FIXED_OF_FEW } else { MAX_FIXED };
    let whole_ms = median(pieces.iter().map(|piece| piece.ms / piece.rays).collect())?;
    let ray_ms = median(slopes.collect())
        .map_or(whole_ms, |slope| slope.clamp((1.0 - max_fixed) * whole_ms, whole_ms));
    let fixed_ms = median(pieces.iter().map(|piece| piece.ms - ray_ms * piece.rays).collect())?;
    Some((fixed_ms.max(0.0), ray_ms))
}

fn median(values: Vec<f64>) -> Option<f64> {
    quantile(0.5, values)
}

/// The value below which lies so large a part of the others; the lower one between two.
fn quantile(part: f64, mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get((part * values.len().saturating_sub(1) as f64) as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_of_stalled_pieces_does_not_move_the_line() {
        let mut history = CostHistory::default();
        for index in 0..64_u32 {
            let rays = if index % 2 == 0 { 2000.0 } else { 1000.0 };
            let stall_ms = if index % 4 == index / 8 % 4 { 50.0 } else { 0.0 };
            history.learn(Phase::Refining, rays, 3.0 + 0.004 * rays + stall_ms);
        }
        let rate = history.rate(Phase::Refining).expect("pieces");
        assert!((rate.ray_ms - 0.004).abs() < 1e-9, "{rate:?}");
        assert!((rate.fixed_ms - 3.0).abs() < 1e-6, "{rate:?}");
    }

    /// What pieces and openings of a cheap view cost: a microsecond a ray.
    fn known() -> CostHistory {
        let mut history = CostHistory::default();
        for index in 0..32_u32 {
            let rays = if index % 2 == 0 { 2000.0 } else { 1000.0 };
            history.learn(Phase::Refining, rays, 0.001 * rays);
            history.learn(Phase::Opening, rays, 0.001 * rays);
        }
        history
    }

    /// Rays that are nothing like those of the opening come a few at a time.
    #[test]
    fn pieces_grow_from_a_jump_step_by_step() {
        let mut history = known();
        history.learn(Phase::Jump, 20.0, 0.02);
        for most_rays in [100.0, 500.0, 2500.0] {
            let rate = history.rate(Phase::Refining).expect("a rate");
            assert_eq!(rate.max_rays, most_rays);
            history.learn(Phase::Refining, rate.max_rays, 0.001 * rate.max_rays);
        }
    }

    /// The next piece after a jump is sized by the jump's own cost.
    #[test]
    fn an_expensive_jump_replaces_the_estimates_at_once() {
        let ray_ms = |history: &CostHistory, phase| history.rate(phase).expect("a rate").ray_ms;
        let mut jumped = known();
        jumped.learn(Phase::Jump, 1000.0, 20.0);
        let mut opened = known();
        opened.learn(Phase::Opening, 1000.0, 20.0);
        let mut alike = known();
        alike.learn(Phase::Jump, 1000.0, 1.5);
        for phase in [Phase::Opening, Phase::Refining] {
            assert!((ray_ms(&jumped, phase) - 0.02).abs() < 1e-9, "{jumped:?}");
            assert!(ray_ms(&opened, phase) < 0.002, "{opened:?}");
            assert!(ray_ms(&alike, phase) < 0.002, "{alike:?}");
        }
    }

    /// The time of the first piece after a jump may be reported as that of a frame beside it.
    #[test]
    fn few_short_pieces_after_an_expensive_jump_do_not_make_its_rays_cheap() {
        let mut history = known();
        history.learn(Phase::Jump, 1000.0, 60.0);
        let ray_ms = |history: &CostHistory| history.rate(Phase::Refining).expect("a rate").ray_ms;
        for _ in 1..MANY_PIECES {
            history.learn(Phase::Refining, 500.0, 0.5);
            assert!((ray_ms(&history) - 0.02).abs() < 1e-9, "{history:?}");
        }
        history.learn(Phase::Refining, 500.0, 0.5);
        assert!(ray_ms(&history) < 0.002, "{history:?}");
    }

    #[test]
    fn the_first_pieces_without_an_opening_grow_carefully() {
        let mut history = CostHistory::default();
        let sizes = [300.0, 600.0, 1200.0, 6000.0].map(|rays| {
            history.learn(Phase::Refining, rays, 1.0);
            history.rate(Phase::Refining).expect("a rate").max_rays
        });
        assert_eq!(sizes, [600.0, 1200.0, 6000.0, 30_000.0]);
    }

    /// Twice as many rays as the largest short piece where all of the time seems fixed and is too long; five times as many as
    /// the largest piece elsewhere.
    #[test]
    fn pieces_of_equal_times_grow_carefully_where_they_are_too_long() {
        let mut history = CostHistory::default();
        for index in 0..MANY_PIECES {
            history.learn(Phase::Refining, if index % 2 == 0 { 200.0 } else { 100.0 }, 50.0);
        }
        let rays = |history: &CostHistory, aim_ms| {
            history.rate(Phase::Refining).expect("pieces").rays(aim_ms)
        };
        assert_eq!((rays(&history, 8.0), rays(&history, 60.0)), (400.0, 1000.0));
        history.learn(Phase::Refining, 400.0, 150.0);
        assert_eq!(rays(&history, 8.0), 400.0, "a long piece is no base");
        history.learn(Phase::Refining, 400.0, 60.0);
        assert_eq!(rays(&history, 8.0), 800.0);
    }

    #[test]
    fn one_stalled_opening_does_not_change_the_estimate() {
        let mut history = CostHistory::default();
        for ms in [500.0, 10.0, 10.0, 10.0, 10.0, 300.0, 10.0] {
            history.learn(Phase::Opening, 1000.0, ms);
        }
        let rate = history.rate(Phase::Opening).expect("openings");
        assert!((rate.ray_ms - 0.01).abs() < 1e-9, "{rate:?}");
    }
}

//! One axis: from values to pixels, and its ticks.

use super::text;

/// A tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Where.
    pub value: f64,
    /// Its label; none for a small one between.
    pub label: Option<String>,
}

/// Bounds and direction, linear or logarithmic.
pub(super) struct Axis {
    low: f64,
    high: f64,
    log: bool,
    from: f64,
    to: f64,
}

impl Axis {
    /// An axis from pixel `from` to pixel `to`, over a range or over these values and a little
    /// more.
    pub fn new(
        values: impl Iterator<Item = f64>,
        range: Option<[f64; 2]>,
        log: bool,
        [from, to]: [f64; 2],
    ) -> Self {
        let scale = |x: f64| if log { libm::log10(x) } else { x };
        let of_values = || {
            let shown = values.filter(|x| x.is_finite() && (!log || *x > 0.0));
            let (low, high) = shown
                .map(scale)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                    (l.min(x), h.max(x))
                });
            let room = if high > low { 0.05 * (high - low) } else { 0.5 };
            if low.is_finite() {
                [low - room, high + room]
            } else {
                [0.0, 1.0]
            }
        };
        let [low, high] = range.map_or_else(of_values, |range| range.map(scale));
        Self {
            low,
            high,
            log,
            from,
            to,
        }
    }

    /// The pixel of a value; `None` where it cannot be shown.
    pub fn place(&self, x: f64) -> Option<f64> {
        let x = if self.log { libm::log10(x) } else { x };
        let t = (x - self.low) / (self.high - self.low);
        (x.is_finite() && (-0.001..=1.001).contains(&t))
            .then_some(self.from + t * (self.to - self.from))
    }

    /// The power of ten that the labels are multiples of: 0 where they are short enough as they
    /// are.
    pub fn exponent(&self) -> i32 {
        let largest = self.low.abs().max(self.high.abs());
        if self.log || largest == 0.0 || (0.02..1e4).contains(&largest) {
            return 0;
        }
        libm::floor(libm::log10(largest)) as i32
    }

    /// Where the ticks are.
    pub fn ticks(&self) -> Vec<Tick> {
        let ticks = if self.log {
            self.logarithmic()
        } else {
            self.linear()
        };
        ticks
            .into_iter()
            .filter(|tick| self.place(tick.value).is_some())
            .collect()
    }

    fn linear(&self) -> Vec<Tick> {
        let raw = (self.high - self.low) / 6.0;
        let decade = libm::pow(10.0, libm::floor(libm::log10(raw)));
        // A labelled step and the small ones in it.
        let (step, parts) = [(1.0, 5), (2.0, 4), (5.0, 5), (10.0, 5)]
            .map(|(m, parts)| (m * decade, parts))
            .into_iter()
            .find(|(step, _)| *step >= raw)
            .unwrap_or((raw, 1));
        let unit = libm::pow(10.0, f64::from(self.exponent()));
        let small = step / parts as f64;
        let first = (self.low / small).ceil() as i64;
        let last = (self.high / small).floor() as i64;
        (first..=last)
            .map(|k| {
                let value = k as f64 * small;
                Tick {
                    value,
                    label: (k % parts == 0).then(|| text::number(value / unit)),
                }
            })
            .collect()
    }

    fn logarithmic(&self) -> Vec<Tick> {
        let (first, last) = (self.low.ceil() as i32, self.high.floor() as i32);
        let decade = |e: i32| libm::pow(10.0, f64::from(e));
        if last - first >= 1 {
            let every = (last - first) / 7 + 1;
            let named = |e: i32| e.rem_euclid(every) == 0;
            let decades = (first..=last).map(|e| Tick {
                value: decade(e),
                label: named(e).then(|| text::power(e)),
            });
            // Between neighbouring labels there is room for the digits.
            let digits = (first - 1..=last)
                .filter(|_| every == 1)
                .flat_map(|e| (2..10).map(move |d| f64::from(d) * decade(e)));
            return decades
                .chain(digits.map(|value| Tick { value, label: None }))
                .collect();
        }
        // Hardly a decade or less: labels at the digits, as many as there is room for.
        let shown: Vec<(i32, i32)> = (first - 2..=last + 1)
            .flat_map(|e| (1..10).map(move |d| (d, e)))
            .filter(|&(d, e)| {
                (self.low..=self.high).contains(&libm::log10(f64::from(d) * decade(e)))
            })
            .collect();
        let few = shown.len() <= 5;
        let label =
            |d: i32, e| (few || matches!(d, 1 | 2 | 5)).then(|| text::logarithmic(f64::from(d), e));
        shown
            .into_iter()
            .map(|(d, e)| Tick {
                value: f64::from(d) * decade(e),
                label: label(d, e),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Axis;

    fn labels(range: [f64; 2], log: bool) -> Vec<String> {
        let axis = Axis::new(std::iter::empty(), Some(range), log, [0.0, 100.0]);
        axis.ticks().into_iter().filter_map(|t| t.label).collect()
    }

    #[test]
    fn every_axis_has_at_least_two_labels_and_no_more_than_it_has_room_for() {
        let ranges = [
            ([0.0, 1.0], false),
            ([-3e-9, 4.7e-8], false),
            ([0.0, 123_456.0], false),
            ([-0.0021, 0.0001], false),
            ([0.018, 0.044], true),
            ([16.0, 52.0], true),
            ([1.8e3, 9e4], true),
            ([1e-15, 1.0], true),
            ([2e-7, 5e-6], true),
        ];
        for (range, log) in ranges {
            let labels = labels(range, log);
            assert!((2..=9).contains(&labels.len()), "{range:?} {labels:?}");
            let mut distinct = labels.clone();
            distinct.dedup();
            assert_eq!(labels, distinct);
        }
    }

    #[test]
    fn small_numbers_share_a_power_of_ten() {
        let axis = Axis::new(std::iter::empty(), Some([-2e-3, 5e-4]), false, [0.0, 100.0]);
        assert_eq!(axis.exponent(), -3);
        let axis = Axis::new(std::iter::empty(), Some([0.0, 4.0]), false, [0.0, 100.0]);
        assert_eq!(axis.exponent(), 0);
    }
}

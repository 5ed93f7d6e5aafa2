//! The unit in which people read the times of a scene.

/// A unit of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeUnit {
    /// s, ms, µs or ns.
    pub name: &'static str,
    /// Its length, s.
    pub seconds: f64,
}

const UNITS: [TimeUnit; 4] = [
    TimeUnit {
        name: "s",
        seconds: 1.0,
    },
    TimeUnit {
        name: "ms",
        seconds: 1e-3,
    },
    TimeUnit {
        name: "µs",
        seconds: 1e-6,
    },
    TimeUnit {
        name: "ns",
        seconds: 1e-9,
    },
];

impl TimeUnit {
    /// The longest unit of which a run from home to the turnaround takes a twentieth or more.
    #[must_use]
    pub fn of(span: f64) -> Self {
        let fits = |unit: &&Self| span >= 0.05 * unit.seconds;
        let unit = UNITS.iter().find(fits);
        // A run of no length is read in seconds.
        *unit.filter(|_| span > 0.0).unwrap_or(&UNITS[0])
    }

    /// A time in this unit.
    #[must_use]
    pub fn count(self, time: f64) -> f64 {
        time / self.seconds
    }
}

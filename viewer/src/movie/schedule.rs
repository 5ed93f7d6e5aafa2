//! Which picture shows which step.

use loschmidt_runner::Plan;

/// The steps that the pictures of a movie show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// Steps of the way out.
    pub out: u64,
    /// Steps of both legs.
    pub total: u64,
    /// Number of pictures, at least 2.
    pub pictures: usize,
}

impl Schedule {
    /// Evenly paced pictures of a run.
    #[must_use]
    pub fn new(plan: &Plan, pictures: usize) -> Self {
        Self {
            out: plan.out,
            total: plan.total(),
            pictures: pictures.max(2),
        }
    }

    /// Steps taken over both legs when a picture is taken.
    #[must_use]
    pub fn step(&self, picture: usize) -> u64 {
        let last = self.pictures - 1;
        let picture = picture.min(last);
        let rounded = |n: usize| {
            let (n, last) = (n as u128, last as u128);
            // At most the total.
            ((2 * n * u128::from(self.total) + last) / (2 * last)) as u64
        };
        if 2 * picture <= last {
            rounded(picture)
        } else {
            self.total - rounded(last - picture)
        }
    }

    /// How far the arrow of time has turned in a picture, 0 to 1: it takes 0.7 s of the movie
    /// around the turnaround. `None` where time is not turned.
    #[must_use]
    pub fn turn(&self, picture: usize, fps: u32) -> Option<f64> {
        const SECONDS: f64 = 0.7;
        if self.out == self.total {
            return None;
        }
        let turnaround = self.out as f64 / self.total as f64 * (self.pictures - 1) as f64;
        let since = (picture as f64 - turnaround) / f64::from(fps);
        let x = (since / SECONDS + 0.5).clamp(0.0, 1.0);
        Some(x * x * (3.0 - 2.0 * x))
    }
}

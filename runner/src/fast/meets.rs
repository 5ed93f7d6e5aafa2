//! Who can meet whom in one strip.

/// A particle, counted from the first of its strip, and a row that it meets, counted from the first
/// row of its strip.
pub(super) type Meeting = [u32; 2];

/// The meetings of a strip. The sweeps rely on its bounds without looking at each meeting, so they
/// are read off the finished list and nothing changes it afterwards.
#[derive(Debug, Default)]
pub(super) struct Meets {
    list: Vec<Meeting>,
    length: usize,
    particles: usize,
    rows: usize,
}

impl Meets {
    /// No meetings.
    pub const fn new() -> Self {
        Self {
            list: Vec::new(),
            length: 0,
            particles: 0,
            rows: 0,
        }
    }

    /// Lists anew; `write` fills a list and returns how many meetings of it count.
    pub fn renew(&mut self, write: impl FnOnce(&mut Vec<Meeting>) -> usize) {
        let length = write(&mut self.list);
        self.length = length.min(self.list.len());
        let (mut particles, mut rows) = (0, 0);
        for [particle, row] in self.list() {
            particles = particles.max(particle + 1);
            rows = rows.max(row + 1);
        }
        (self.particles, self.rows) = (particles as usize, rows as usize);
    }

    /// The meetings.
    pub fn list(&self) -> &[Meeting] {
        &self.list[..self.length]
    }

    /// All particles in the list are below this.
    pub fn particles(&self) -> usize {
        self.particles
    }

    /// All rows in the list are below this.
    pub fn rows(&self) -> usize {
        self.rows
    }
}

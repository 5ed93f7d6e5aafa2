//! Who can meet whom in one strip.

/// A particle, counted from the first of its strip, and a row that it meets, counted from the first
/// row of its strip.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Meeting {
    particle: u16,
    /// The row times [`step`].
    at: u16,
}

/// Rows are counted in steps of this in dimension `d`. In the plane, a number of steps times 8 is
/// the byte at which the coordinates of the row begin, times 4 that of one component: the processor
/// multiplies by these as it reads.
pub(super) const fn step(d: usize) -> usize {
    if d == 2 { 8 } else { 1 }
}

impl Meeting {
    /// Numbers that a meeting can hold.
    const NUMBERS: usize = 1 << u16::BITS;

    /// In dimension D.
    #[inline(always)]
    pub fn new<const D: usize>(particle: usize, row: usize) -> Self {
        Self {
            particle: particle as u16,
            at: (row * step(D)) as u16,
        }
    }
    /// Whether all meetings of a strip with so many particles, and so many rows up to the last that
    /// they can meet, can be named. They can up to 16,000 particles a strip in the plane and up to
    /// 130,000 a layer in space; the sums of larger sets are left to the plain traversal.
    pub fn can_name<const D: usize>(particles: usize, rows: usize) -> bool {
        particles <= Self::NUMBERS && rows * step(D) <= Self::NUMBERS
    }
    /// The particle.
    #[inline(always)]
    pub fn particle(self) -> usize {
        usize::from(self.particle)
    }
    /// The row, in [`step`]s.
    #[inline(always)]
    pub fn at(self) -> usize {
        usize::from(self.at)
    }
}

/// The meetings of a strip. The sweeps rely on its bounds without looking at each meeting, so they
/// are read off the finished list and nothing changes it afterwards.
#[derive(Debug, Default)]
pub(super) struct Meets {
    list: Vec<Meeting>,
    particles: usize,
    rows: usize,
}

impl Meets {
    /// No meetings.
    pub const fn new() -> Self {
        Self {
            list: Vec::new(),
            particles: 0,
            rows: 0,
        }
    }

    /// Lists these meetings.
    pub fn renew<const D: usize>(&mut self, list: &[Meeting]) {
        self.list.clear();
        if self.list.capacity() < list.len() {
            // Vectors that double would hold half as much again; lists grow by little.
            self.list.reserve_exact(list.len() + list.len() / 16);
        }
        self.list.extend_from_slice(list);
        // In the numbers as they are stored, which the compiler compares eight at a time.
        let (mut last, mut at) = (0u16, 0u16);
        for meeting in list {
            last = last.max(meeting.particle);
            at = at.max(meeting.at);
        }
        let some = usize::from(!list.is_empty());
        self.particles = usize::from(last) + some;
        self.rows = usize::from(at) / step(D) + some;
    }

    /// The meetings.
    pub fn list(&self) -> &[Meeting] {
        &self.list
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

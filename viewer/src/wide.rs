//! Plain loops for the widest vectors that the processor has, chosen when the program runs.

/// Does `work` as it is compiled for this processor. The bits are the same as without: every
/// operation is rounded by itself, and none is contracted with another.
///
/// `work` and what it calls must be inlined to gain by it.
#[inline(always)]
pub(crate) fn wide<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

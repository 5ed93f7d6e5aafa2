//! Which known word a misspelt one was meant to be.

/// The candidate nearest to `word`, when it is near enough to be a slip of the pen.
pub(super) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // Longer than any word that is known: no slip of the pen, and slow to compare.
    if word.len() > 100 {
        return None;
    }
    let lower = word.to_lowercase();
    let allowed = (word.chars().count() / 3).max(1);
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&lower, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_is_recognised_and_another_word_is_not() {
        let words = ["particle_spacing", "support", "cfl"];
        assert_eq!(nearest("particle_spacign", words), Some("particle_spacing"));
        assert_eq!(nearest("CFL", words), Some("cfl"));
        assert_eq!(nearest("viscosity", words), None);
    }
}

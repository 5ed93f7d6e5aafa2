//! Numbers with names: what a pass reads of a particle, and what it adds to one.
//!
//! A pass speaks of `i.pressure` or `sum.gradient[0][1]`; an executor, which knows nothing of
//! pressures, walks the same numbers one after another. [`Values`] is the executor's side:
//! the number type T is a double, a row of doubles, an integer sum, or a [`Parity`] of each.
//! Vectors are `[T; D]`, matrices `[[T; D]; D]`, a scalar is T itself, nothing is `[T; 0]`, and
//! [`values!`](crate::values!) makes a struct of several of them.
//!
//! [`Parity`]: crate::pairs::Parity

/// Some numbers of one type, in a fixed order.
pub trait Values<T: Copy>: Copy {
    /// How many.
    const COUNT: usize;
    /// Of the numbers `value(0)`, `value(1)`, …, which are asked for in this order, each once.
    fn from_fn(value: impl FnMut(usize) -> T) -> Self;
    /// Number k.
    fn get(&self, k: usize) -> T;
    /// Sets number k.
    fn set(&mut self, k: usize, value: T);
}

impl<T: Copy> Values<T> for T {
    const COUNT: usize = 1;
    #[inline(always)]
    fn from_fn(mut value: impl FnMut(usize) -> T) -> Self {
        value(0)
    }
    #[inline(always)]
    fn get(&self, _: usize) -> T {
        *self
    }
    #[inline(always)]
    fn set(&mut self, _: usize, value: T) {
        *self = value;
    }
}

impl<T: Copy, const N: usize> Values<T> for [T; N] {
    const COUNT: usize = N;
    // Loops, not `core::array::from_fn`: that may stay a call, which the vector instructions of the
    // caller would not reach.
    #[inline(always)]
    fn from_fn(mut value: impl FnMut(usize) -> T) -> Self {
        if N == 0 {
            return core::array::from_fn(value);
        }
        let mut numbers = [value(0); N];
        for (k, number) in numbers.iter_mut().enumerate().skip(1) {
            *number = value(k);
        }
        numbers
    }
    #[inline(always)]
    fn get(&self, k: usize) -> T {
        self[k]
    }
    #[inline(always)]
    fn set(&mut self, k: usize, value: T) {
        self[k] = value;
    }
}

impl<T: Copy, const N: usize, const M: usize> Values<T> for [[T; M]; N] {
    const COUNT: usize = N * M;
    #[inline(always)]
    fn from_fn(mut value: impl FnMut(usize) -> T) -> Self {
        let mut numbers = [[value(0); M]; N];
        for k in 1..N * M {
            numbers[k / M][k % M] = value(k);
        }
        numbers
    }
    #[inline(always)]
    fn get(&self, k: usize) -> T {
        self[k / M][k % M]
    }
    #[inline(always)]
    fn set(&mut self, k: usize, value: T) {
        self[k / M][k % M] = value;
    }
}

/// A symmetric matrix, of which the D(D + 1)/2 numbers on and above the diagonal count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetric<T, const D: usize> {
    /// Row by row; what is below the diagonal repeats what is above it.
    pub rows: [[T; D]; D],
}

/// Row and column of number k on or above the diagonal.
#[inline(always)]
const fn row_and_column(dimension: usize, mut k: usize) -> (usize, usize) {
    let mut row = 0;
    while k >= dimension - row {
        k -= dimension - row;
        row += 1;
    }
    (row, row + k)
}

impl<T: Copy, const D: usize> Values<T> for Symmetric<T, D> {
    const COUNT: usize = D * (D + 1) / 2;
    #[inline(always)]
    fn from_fn(mut value: impl FnMut(usize) -> T) -> Self {
        let mut rows = [[value(0); D]; D];
        for k in 1..<Self as Values<T>>::COUNT {
            let (i, j) = row_and_column(D, k);
            let x = value(k);
            rows[i][j] = x;
            rows[j][i] = x;
        }
        Self { rows }
    }
    #[inline(always)]
    fn get(&self, k: usize) -> T {
        let (i, j) = row_and_column(D, k);
        self.rows[i][j]
    }
    #[inline(always)]
    fn set(&mut self, k: usize, value: T) {
        let (i, j) = row_and_column(D, k);
        self.rows[i][j] = value;
        self.rows[j][i] = value;
    }
}

/// Declares a struct of named numbers in D dimensions and makes it [`Values`].
///
/// ```
/// loschmidt_core::values! {
///     /// What a viscous force needs of a particle.
///     pub struct Flowing {
///         /// u
///         velocity: [T; D],
///         /// ρ
///         density: T,
///     }
/// }
/// use loschmidt_core::values::Values;
/// assert_eq!(<Flowing<f64, 3> as Values<f64>>::COUNT, 4);
/// assert_eq!(Flowing::<f64, 3>::from_fn(|k| k as f64).density, 3.0);
/// ```
#[macro_export]
macro_rules! values {
    ($($(#[$doc:meta])* $vis:vis struct $name:ident {
        $($(#[$field_doc:meta])* $field:ident: $kind:ty),+ $(,)?
    })+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $vis struct $name<T, const D: usize> {
            $($(#[$field_doc])* pub $field: $kind,)+
        }

        impl<T: Copy, const D: usize> $crate::values::Values<T> for $name<T, D> {
            const COUNT: usize = 0 $(+ <$kind as $crate::values::Values<T>>::COUNT)+;
            #[inline(always)]
            fn from_fn(mut value: impl FnMut(usize) -> T) -> Self {
                let mut first = 0;
                Self {$($field: {
                    let from = first;
                    first += <$kind as $crate::values::Values<T>>::COUNT;
                    let _ = first;
                    <$kind as $crate::values::Values<T>>::from_fn(
                        #[inline(always)]
                        |k| value(from + k),
                    )
                },)+}
            }
            #[inline(always)]
            fn get(&self, k: usize) -> T {
                let mut first = 0;
                $(
                    let count = <$kind as $crate::values::Values<T>>::COUNT;
                    if k < first + count {
                        return $crate::values::Values::<T>::get(&self.$field, k - first);
                    }
                    first += count;
                )+
                unreachable!("number {k} of {first}")
            }
            #[inline(always)]
            fn set(&mut self, k: usize, value: T) {
                let mut first = 0;
                $(
                    let count = <$kind as $crate::values::Values<T>>::COUNT;
                    if k < first + count {
                        return $crate::values::Values::<T>::set(&mut self.$field, k - first, value);
                    }
                    first += count;
                )+
                let _ = first;
            }
        }
    )+};
}

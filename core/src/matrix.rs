//! Small matrices, from `+ - * /` in one written order.

use crate::values::Symmetric;

/// D × D numbers, row by row.
pub(crate) type Matrix<const D: usize> = [[f64; D]; D];

/// Below this determinant of -H the inverse is no longer taken as it is: see [`damped_inverse`].
/// At the corners of bodies it is 0.06 and more in the plane, but 0.004 in space.
const fn least_determinant(dimension: usize) -> f64 {
    match dimension {
        2 => 0.03,
        _ => 0.001,
    }
}

/// 1.
pub(crate) fn identity<const D: usize>() -> Matrix<D> {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }))
}

/// a b.
#[inline(always)]
pub(crate) fn product<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    let mut c = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..D {
            let mut sum = a[i][0] * b[0][j];
            for k in 1..D {
                sum += a[i][k] * b[k][j];
            }
            c[i][j] = sum;
        }
    }
    c
}

/// aᵀ a.
#[inline(always)]
pub(crate) fn metric<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut g = [[0.0; D]; D];
    for i in 0..D {
        for j in i..D {
            let mut sum = a[0][i] * a[0][j];
            for row in &a[1..] {
                sum += row[i] * row[j];
            }
            g[i][j] = sum;
            g[j][i] = sum;
        }
    }
    g
}

/// The sum of the diagonal.
#[inline(always)]
pub(crate) fn trace<const D: usize>(a: &Matrix<D>) -> f64 {
    let mut sum = a[0][0];
    for (i, row) in a.iter().enumerate().skip(1) {
        sum += row[i];
    }
    sum
}

/// adj(a), with a adj(a) = det(a) 1.
#[inline(always)]
pub(crate) fn adjugate<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut adj = [[0.0; D]; D];
    if D == 2 {
        adj[0][0] = a[1][1];
        adj[0][1] = -a[0][1];
        adj[1][0] = -a[1][0];
        adj[1][1] = a[0][0];
    } else {
        for (i, row) in adj.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                let (r, s) = ((j + 1) % D, (j + 2) % D);
                let (p, q) = ((i + 1) % D, (i + 2) % D);
                *x = a[r][p] * a[s][q] - a[r][q] * a[s][p];
            }
        }
    }
    adj
}

/// det(a), from its first row and the first column of its adjugate.
#[inline(always)]
pub(crate) fn determinant<const D: usize>(a: &Matrix<D>, adjugate: &Matrix<D>) -> f64 {
    let mut sum = a[0][0] * adjugate[0][0];
    for k in 1..D {
        sum += a[0][k] * adjugate[k][0];
    }
    sum
}

/// det(a).
pub(crate) fn determinant_of<const D: usize>(a: &Matrix<D>) -> f64 {
    determinant(a, &adjugate(a))
}

/// a⁻¹ of a matrix with a determinant that is not zero.
#[inline(always)]
pub(crate) fn inverse<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut inverse = adjugate(a);
    let factor = 1.0 / determinant(a, &inverse);
    for x in inverse.as_flattened_mut() {
        *x *= factor;
    }
    inverse
}

/// Whether [`damped_inverse`] is not the inverse of this H.
pub(crate) fn is_damped<const D: usize>(moment: &Symmetric<f64, D>) -> bool {
    determinant_of(&moment.rows.map(|row| row.map(|x| -x))) < const { least_determinant(D) }
}

/// What stands for H⁻¹, of the positive matrix p = -H: -adj(p) g(det p), where g(d) is 1/d for
/// d >= ε and d (3 - 2 d/ε)/ε² below, which goes on smoothly and ends in 0.
///
/// A particle with too few neighbours, or with all of them on a line, has a singular H. Every
/// multiple of the adjugate keeps T H symmetric and so exerts no torque; at 0 the particle feels no
/// shear and its distortion stands still. Inside a body p is about 1, and nothing is changed.
#[inline(always)]
pub(crate) fn damped_inverse<const D: usize>(moment: &Symmetric<f64, D>) -> Symmetric<f64, D> {
    let positive = moment.rows.map(|row| row.map(|x| -x));
    let mut rows = adjugate(&positive);
    let d = determinant(&positive, &rows);
    let least = const { least_determinant(D) };
    let g = if d >= least {
        1.0 / d
    } else {
        d * (3.0 - 2.0 * (d / least)) / (least * least)
    };
    for x in rows.as_flattened_mut() {
        *x *= -g;
    }
    Symmetric { rows }
}

//! Solver for small symmetric systems of linear equations.

use crate::geometry::tolerances;

/// Solves `matrix · x = right` for a symmetric, positive definite matrix. Reads the upper triangle only;
/// returns `None` if the matrix is not positive definite.
///
/// Source: the square-root-free form of Cholesky's method, Golub and Van Loan, Matrix Computations, section
/// 4.1.
#[must_use]
pub(crate) fn solve<const N: usize>(matrix: [[f64; N]; N], right: [f64; N]) -> Option<[f64; N]> {
    let mut l = matrix;
    let mut d = [0.0; N];
    let trace: f64 = (0..N).map(|i| matrix[i][i]).sum();
    for i in 0..N {
        let mut pivot = matrix[i][i];
        for k in 0..i {
            pivot -= l[i][k] * l[i][k] * d[k];
        }
        if pivot.partial_cmp(&(tolerances::MIN_PIVOT_OF_TRACE * trace)) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        d[i] = pivot;
        for j in i + 1..N {
            let mut entry = matrix[i][j];
            for k in 0..i {
                entry -= l[i][k] * l[j][k] * d[k];
            }
            l[j][i] = entry / pivot;
        }
    }
    let mut x = right;
    for i in 0..N {
        for k in 0..i {
            x[i] -= l[i][k] * x[k];
        }
    }
    for i in 0..N {
        x[i] /= d[i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            x[i] -= l[k][i] * x[k];
        }
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn solve_satisfies_the_equations() {
        let matrix = [[4.0, 1.0, 0.5], [1.0, 3.0, -1.0], [0.5, -1.0, 2.0]];
        let x = solve(matrix, [1.0, 2.0, 3.0]).expect("a definite matrix");
        for (row, right) in matrix.iter().zip([1.0, 2.0, 3.0]) {
            let sum: f64 = row.iter().zip(x).map(|(a, b)| a * b).sum();
            assert!((sum - right).abs() < 1e-12, "{x:?}");
        }
        assert_eq!(solve([[1.0, 1.0], [1.0, 1.0]], [1.0, 1.0]), None);
    }
}

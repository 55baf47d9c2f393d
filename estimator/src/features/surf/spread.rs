//! Which maxima to keep: the strongest, but spread over the image.

use super::hessian::Maximum;

/// The strongest `budget` maxima, strongest first. Each cell of `cell` pixels gets at most twice its fair share;
/// what then is left of the budget goes to the strongest of the rest.
pub fn spread(mut maxima: Vec<Maximum>, size: (usize, usize), cell: usize, budget: usize) -> Vec<Maximum> {
    // Position breaks ties, so that the order is one.
    let strongest_first = |a: &Maximum, b: &Maximum| {
        b.response.total_cmp(&a.response).then(a.y.total_cmp(&b.y)).then(a.x.total_cmp(&b.x))
    };
    maxima.sort_unstable_by(strongest_first);
    if maxima.len() <= budget {
        return maxima;
    }
    let (columns, rows) = (size.0.div_ceil(cell), size.1.div_ceil(cell));
    let share = (2 * budget).div_ceil(columns * rows).max(1);
    let mut taken = vec![0_usize; columns * rows];
    let (mut kept, mut rest) = (Vec::with_capacity(budget), Vec::new());
    for maximum in maxima {
        let index = (maximum.y as usize / cell).min(rows - 1) * columns + (maximum.x as usize / cell).min(columns - 1);
        if taken[index] < share {
            taken[index] += 1;
            kept.push(maximum);
        } else {
            rest.push(maximum);
        }
    }
    kept.extend(rest);
    kept.truncate(budget);
    kept.sort_unstable_by(strongest_first);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, y: f32, response: f32) -> Maximum {
        Maximum { x, y, scale: 2.0, response, laplacian_positive: true }
    }

    #[test]
    fn one_poster_does_not_win() {
        let poster = (0..500).map(|i| at(10.0 + (i % 50) as f32, 10.0 + (i / 50) as f32, 1000.0 + i as f32));
        let elsewhere = (0..40).map(|i| at(100.0 + 50.0 * (i % 10) as f32, 100.0 + 80.0 * (i / 10) as f32, 1.0));
        let kept = spread(poster.chain(elsewhere).collect(), (640, 480), 80, 100);
        assert_eq!(kept.len(), 100);
        assert_eq!(kept.iter().filter(|maximum| maximum.response < 2.0).count(), 40);
        assert!(kept.is_sorted_by(|a, b| a.response >= b.response));
    }
}

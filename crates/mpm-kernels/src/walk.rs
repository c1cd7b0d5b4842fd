//! All products of one factor per axis.

use crate::Layout;

/// What is done on the way over the nodes of a stencil with W nodes per axis. A trait and not two closures: methods can be made
/// to be inlined, which keeps sums over the nodes in registers.
pub(crate) trait Walker<P> {
    /// The product over the axes before `axis`, taken over to that axis with factor j.
    fn extend(&self, axis: usize, j: usize, before: &P) -> P;

    /// A row of W nodes along the last axis, by the place of its first node and the product over the axes before.
    fn row(&mut self, first: usize, before: &P);
}

/// Visit all products over the axes but the last, the last but one fastest.
///
/// The inner loops have a constant length, so that they unroll; products over the outer axes are carried along and
/// renewed only from the first digit that changed.
#[inline(always)]
pub(crate) fn walk<const W: usize, const D: usize, P: Copy>(one: P, layout: &Layout<D>, walker: &mut impl Walker<P>) {
    let first = layout.first();
    match D {
        1 => walker.row(first, &one),
        2 => {
            for i in 0..W {
                let row = walker.extend(0, i, &one);
                walker.row(first + i * layout.stride(0), &row);
            }
        }
        3 => {
            const { assert!(W <= 4, "planes are written out") }
            plane::<0, W, D, P>(&one, layout, walker);
            plane::<1, W, D, P>(&one, layout, walker);
            plane::<2, W, D, P>(&one, layout, walker);
            plane::<3, W, D, P>(&one, layout, walker);
        }
        _ => {
            let mut digit = [0usize; D];
            let mut products = [one; D];
            let mut changed = 0;
            loop {
                for a in changed..D - 2 {
                    products[a + 1] = walker.extend(a, digit[a], &products[a]);
                }
                let plane = (0..D - 2).fold(first, |place, a| place + digit[a] * layout.stride(a));
                for j in 0..W {
                    let row = walker.extend(D - 2, j, &products[D - 2]);
                    walker.row(plane + j * layout.stride(D - 2), &row);
                }
                changed = D - 3;
                digit[changed] += 1;
                while digit[changed] == W {
                    if changed == 0 {
                        return;
                    }
                    digit[changed] = 0;
                    changed -= 1;
                    digit[changed] += 1;
                }
            }
        }
    }
}

/// The rows of plane I of a stencil in three dimensions; none where it has no such plane. Written out by the caller: a loop over planes would not unroll, and check
/// places while it runs.
#[inline(always)]
fn plane<const I: usize, const W: usize, const D: usize, P: Copy>(
    one: &P,
    layout: &Layout<D>,
    walker: &mut impl Walker<P>,
) {
    if const { I >= W } {
        return;
    }
    let plane = walker.extend(0, I, one);
    for j in 0..W {
        let row = walker.extend(1, j, &plane);
        walker.row(layout.first() + I * layout.stride(0) + j * layout.stride(1), &row);
    }
}

/// Visit all products over all axes by the place of their node, the last axis fastest: `extend` as [`Walker::extend`].
#[inline(always)]
pub(crate) fn for_each_product<const W: usize, const D: usize, P: Copy>(
    one: P,
    layout: &Layout<D>,
    extend: impl Fn(usize, usize, &P) -> P,
    visit: impl FnMut(usize, &P),
) {
    walk::<W, D, P>(one, layout, &mut Products::<_, _, W, D> { extend, visit });
}

struct Products<E, V, const W: usize, const D: usize> {
    extend: E,
    visit: V,
}

impl<P, E: Fn(usize, usize, &P) -> P, V: FnMut(usize, &P), const W: usize, const D: usize> Walker<P>
    for Products<E, V, W, D>
{
    #[inline(always)]
    fn extend(&self, axis: usize, j: usize, before: &P) -> P {
        (self.extend)(axis, j, before)
    }

    #[inline(always)]
    fn row(&mut self, first: usize, before: &P) {
        for k in 0..W {
            (self.visit)(first + k, &(self.extend)(D - 1, k, before));
        }
    }
}

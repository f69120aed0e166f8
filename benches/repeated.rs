//! Wall clock: parts that stand many times, written out in one function against one function called for each.
//!
//! `cargo bench --bench repeated`. This is what the choice rests on to write repeated parts out (ARCHITECTURE.md, "Repeated
//! parts"): items are four-bars. Written out, the compiler computes two at a time; `RUSTFLAGS=-Cno-vectorize-slp` shows
//! the cost of code size alone.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

macro_rules! rows {
    ($($name:ident $count:literal),*) => {$(
        mod $name {
            use super::*;

            multibody::multibody! {
                mod four {
                    port base: Frame;
                    param crank_length = 1.0;
                    param coupler_length = 3.5;
                    param rocker_length = 3.0;
                    param span = 4.0;
                    body c { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    body k { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
                    body r { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                    joint crank: Revolute { parent: base, child: c, axis: Z }
                    joint coupler: Revolute { parent: c.at(crank_length * X), child: k, axis: Z }
                    joint rocker: Revolute { parent: base.at(span * X), child: r, axis: Z }
                    #[cut]
                    joint pin: Revolute { parent: k.at(coupler_length * X), child: r.at(rocker_length * X), axis: Z }
                    solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
                }
                /// Four-bars side by side.
                pub mod bars {
                    world { gravity: -9.81 * Y }
                    formulation { constraints: Reduced }
                    part bars: [four; $count] = |i| four { base: ground.at(i * Z) };
                    emit forward_dynamics;
                }
            }

            #[divan::bench(sample_size = 1000)]
            fn written_out(bencher: Bencher<'_, '_>) {
                let at = Box::new((bars::Model::<f64>::default(), bars::State::default(), bars::Input::default()));
                bencher.counter(ItemsCount::new($count as usize)).bench_local(|| {
                    let (model, state, input) = black_box(&*at);
                    model.forward_dynamics(0.0, state, input)
                });
            }

            #[divan::bench(sample_size = 1000)]
            fn called(bencher: Bencher<'_, '_>) {
                let one = || (one::bars::Model::<f64>::default(), one::bars::State::default());
                let at: Vec<_> = (0..$count).map(|_| one()).collect();
                bencher.counter(ItemsCount::new($count as usize)).bench_local(|| {
                    for (model, state) in black_box(&at) {
                        black_box(call(model, state));
                    }
                });
            }
        }
    )*};
}
rows!(one 1, ten 10, forty 40, sixty 60);

#[inline(never)]
fn call(model: &one::bars::Model<f64>, state: &one::bars::State<f64>) -> one::bars::Velocity<f64> {
    model.forward_dynamics(0.0, state, &one::bars::Input::default())
}

//! Structs to vectors and back, in the order in which they are recorded.

use multibody::Columns;
use multibody::nalgebra::{SVector, UnitQuaternion};

use super::{flat, loop_of_four, walker};

fn counted<const N: usize>() -> SVector<f64, N> {
    SVector::from_fn(|row, _| 1.0 + row as f64)
}

fn recorded(row: &impl Columns<f64>) -> Vec<f64> {
    let mut list = Vec::new();
    row.each(&mut |_, value| list.push(value));
    list
}

/// Of a struct whose scalars are counted in the order of its vector.
fn check<S: Columns<f64> + Copy, const N: usize>(counted_struct: S)
where
    SVector<f64, N>: From<S>,
{
    let vector = SVector::<f64, N>::from(counted_struct);
    assert_eq!(vector, counted::<N>());
    assert_eq!(recorded(&counted_struct), vector.as_slice());
}

#[test]
fn the_order_is_that_of_columns() {
    check::<_, 24>(walker::Params::from(counted::<24>()));
    check::<_, 44>(walker::Input::from(counted::<44>()));
    check::<_, 4>(walker::States::from(counted::<4>()));
    check::<_, 21>(walker::Velocity::from(counted::<21>()));
    check::<_, 10>(flat::Params::from(counted::<10>()));
    check::<_, 11>(flat::Position::from(counted::<11>()));
    check::<_, 24>(flat::State::from(counted::<24>()));
}

#[test]
fn fields_are_where_they_are_declared() {
    let params = walker::Params::from(counted::<24>());
    assert_eq!(params.legs[0].toes.map(|toe| toe.heavy), [1.0, 2.0]);
    assert_eq!(params.legs[2].ratios, [13.0, 14.0, 15.0]);
    assert_eq!((params.offset.y, params.table[1].z), (17.0, 24.0));
    let input = walker::Input::from(counted::<44>());
    assert_eq!((input.gains[39], input.legs[1].drive, input.r#type), (40.0, 42.0, 44.0));
    let declared = SVector::<f64, 24>::from(walker::Params::default());
    assert_eq!(declared.as_slice()[..5], [0.35, 0.35, 2.0, 3.0, 5.0]);
}

#[test]
fn a_state_with_quaternions_is_normalised() {
    let mut state = walker::State::<f64>::default();
    state.q.float.orientation = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
    (state.q.slide.angle, state.v.legs[2].toes[1].bend, state.x.legs[1].charge) = (0.25, -3.5, 0.125);
    let vector = SVector::<f64, 47>::from(state);
    assert_eq!(recorded(&state), vector.as_slice());
    let mut long = vector;
    long.fixed_rows_mut::<4>(3).scale_mut(7.0);
    let back = walker::State::normalized(long);
    assert!((SVector::<f64, 47>::from(back) - vector).norm() < 1e-15);
    assert_eq!((back.v, back.x), (state.v, state.x));
}

/// The guess is not of the motion: it is that of the default.
#[test]
fn a_guess_starts_anew() {
    let mut state = loop_of_four::State::<f64>::default();
    let start = state.guess;
    (state.q.one, state.v.one, state.guess.two) = (0.3, -0.7, 9.0);
    let vector = SVector::<f64, 2>::from(state);
    assert_eq!(vector, SVector::from([0.3, -0.7]));
    assert_eq!(loop_of_four::State::from(vector), loop_of_four::State { guess: start, ..state });
}

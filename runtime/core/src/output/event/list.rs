//! Lists of events for one search.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use super::track::Track;
use super::{Event, Kind};
use crate::state::State;

/// Events of one search: an [`Event`], an array of events, a tuple of up to eight events with different functions, or `()` for none. With
/// the feature `alloc` also a slice or a vector of events.
pub trait Events<V>: EventList<V> {}

impl<V, E: EventList<V> + ?Sized> Events<V> for E {}

/// The interface of a list of events to the search; sealed.
pub trait EventList<V> {
    /// Search state of each event.
    type Tracks: AsRef<[Track]> + AsMut<[Track]>;

    /// Initial search states.
    fn tracks(&self) -> Self::Tracks;
    /// The kind of the event `index`.
    fn kind(&self, index: usize) -> Kind;
    /// The function of the event `index` at a state.
    fn value(&self, index: usize, state: &State<V>) -> f64;
}

impl<V, G: Fn(&State<V>) -> f64> EventList<V> for Event<G> {
    type Tracks = [Track; 1];

    fn tracks(&self) -> Self::Tracks {
        [Track::default()]
    }

    fn kind(&self, _index: usize) -> Kind {
        self.kind
    }

    fn value(&self, _index: usize, state: &State<V>) -> f64 {
        (self.function)(state)
    }
}

/// Implements `EventList` for lists of events with one function type.
macro_rules! lists {
    ($([$($parameter:tt)*] $list:ty, $tracks:ty, $make:expr;)*) => {$(
        impl<V, G: Fn(&State<V>) -> f64, $($parameter)*> EventList<V> for $list {
            type Tracks = $tracks;

            fn tracks(&self) -> Self::Tracks {
                $make(self.len())
            }

            fn kind(&self, index: usize) -> Kind {
                self[index].kind
            }

            fn value(&self, index: usize, state: &State<V>) -> f64 {
                (self[index].function)(state)
            }
        }
    )*};
}

lists! { [const N: usize] [Event<G>; N], [Track; N], |_| [Track::default(); N]; }

#[cfg(feature = "alloc")]
lists! {
    [] [Event<G>], Vec<Track>, |count| alloc::vec![Track::default(); count];
    [] Vec<Event<G>>, Vec<Track>, |count| alloc::vec![Track::default(); count];
}

/// Implements `EventList` for tuples of events.
macro_rules! tuples {
    ($($count:literal: $($G:ident $index:tt)*;)*) => {$(
        impl<V, $($G: Fn(&State<V>) -> f64),*> EventList<V> for ($(Event<$G>,)*) {
            type Tracks = [Track; $count];

            fn tracks(&self) -> Self::Tracks {
                core::array::from_fn(|_| Track::default())
            }

            fn kind(&self, index: usize) -> Kind {
                match index {
                    $($index => self.$index.kind,)*
                    _ => Kind::new([false; 2]),
                }
            }

            #[allow(unused_variables)]
            fn value(&self, index: usize, state: &State<V>) -> f64 {
                match index {
                    $($index => (self.$index.function)(state),)*
                    _ => f64::NAN,
                }
            }
        }
    )*};
}

tuples! {
    0: ;
    1: A 0;
    2: A 0 B 1;
    3: A 0 B 1 C 2;
    4: A 0 B 1 C 2 D 3;
    5: A 0 B 1 C 2 D 3 E 4;
    6: A 0 B 1 C 2 D 3 E 4 F 5;
    7: A 0 B 1 C 2 D 3 E 4 F 5 G 6;
    8: A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7;
}

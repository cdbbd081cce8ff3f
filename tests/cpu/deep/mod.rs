//! The mathematics of deep views with numbers of 192 bits.
//!
//! | file | what it tests |
//! |---|---|
//! | `arithmetic` | the numbers |
//! | `orbit` | their orbits |
//! | `views` | the views |
//! | `iterations` | the iterations that an anchor adds |
//! | `anchors` | where anchors are found, in how many steps |
//! | `axis` | the field in f64 hard by the polar axis against the march's estimates |
//! | `search` | no test: how the views were found |

mod anchors;
mod arithmetic;
mod axis;
mod iterations;
mod orbit;
mod search;
mod views;

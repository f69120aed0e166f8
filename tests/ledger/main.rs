//! Operations: the ledger, and what each request alone costs.

mod counts;
mod only_what_is_required;
mod planar;

//! Tests of what is left out, against rays.

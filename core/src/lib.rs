//! Core of Loschmidt.
#![no_std]
#![forbid(unsafe_code)]

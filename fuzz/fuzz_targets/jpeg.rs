#![no_main]

#[path = "../fuzzer.rs"]
mod fuzzer;

fuzzer::fuzz!("jpeg");

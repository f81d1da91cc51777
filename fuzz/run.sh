#!/usr/bin/env bash
# Fuzzes the robust threshold for a number of seconds (default 60) on stable Rust: the coverage instrumentation that
# cargo-fuzz switches on with nightly flags is spelled out here. New inputs go into corpus/threshold.
set -euo pipefail
cd "$(dirname "$0")"
export RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
-Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1"
# A target, so that the flags do not reach build scripts.
host=$(rustc -vV | sed -n 's/^host: //p')
cargo build --release --target "$host"
exec "target/$host/release/threshold" -max_total_time="${1:-60}" -max_len=112 -print_final_stats=1 corpus/threshold

//! Every reader of what comes from outside, with thousands of changed inputs.
//!
//! The inputs are made of `fuzz/corpus` and of each target's seeds, and are the same in every run: `MANDELIGHT_SEED`
//! chooses others, `MANDELIGHT_FUZZ` multiplies their number. A failure prints the seed and stores the input as
//! `target/fuzz-failure-TARGET`.

use std::{
    alloc::System,
    collections::BTreeSet,
    env, fs,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    path::{Path, PathBuf},
    process,
    sync::{Mutex, MutexGuard, PoisonError},
    thread,
    time::{Duration, Instant},
};

use cap::Cap;
use fastrand::Rng;
use mandelight_fuzzing::{
    FuzzTarget, Outcome, TARGETS, long_arguments,
    meter::{Allocations, MAX_HELD_BYTES, measured},
    mutated,
};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Inputs of all targets together.
const INPUTS: usize = 100_000;
/// Largest corpus, in bytes.
const MAX_CORPUS_BYTES: u64 = 1 << 20;
/// The seed of the inputs, if the environment has none.
const SEED: u64 = 0x6d61_6e64_656c_6967;

/// Time that no input takes, on a busy machine neither: the largest take tenths of a second.
const ENDLESS: Duration = Duration::from_secs(60);

/// The input that is being read, to be stored if it never ends.
struct Reading {
    since: Instant,
    target: &'static str,
    bytes: Vec<u8>,
}

static READING: Mutex<Option<Reading>> = Mutex::new(None);

fn reading() -> MutexGuard<'static, Option<Reading>> {
    READING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the process at an input that takes [`ENDLESS`], and stores it.
fn watch_for_endless_inputs() {
    static WATCH: std::sync::Once = std::sync::Once::new();
    WATCH.call_once(|| {
        thread::spawn(|| {
            loop {
                thread::sleep(Duration::from_secs(1));
                if let Some(reading) = &*reading()
                    && reading.since.elapsed() > ENDLESS
                {
                    let stored = store(reading.target, &reading.bytes);
                    eprintln!("{}: this input does not end; it is in {stored}", reading.target);
                    process::abort();
                }
            }
        });
    });
}

/// Stores an input that fails; says where, or why not.
fn store(target: &str, bytes: &[u8]) -> String {
    let file = root().join("target").join(format!("fuzz-failure-{target}"));
    match fs::write(&file, bytes) {
        Ok(()) => file.display().to_string(),
        Err(error) => format!("no file: {error}"),
    }
}

/// Keeps other tests from allocating until it is dropped.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn number_of(variable: &str) -> Option<u64> {
    env::var(variable).ok()?.parse().ok()
}

fn root() -> PathBuf {
    // The folder of `tests/fuzzing` or of the package: this file is a test of both.
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().find(|folder| folder.join("fuzz/corpus").is_dir()).expect("a corpus").into()
}

/// The files of a target's corpus, in the order of their names.
fn corpus(target: &FuzzTarget) -> Vec<(String, Vec<u8>)> {
    let folder = root().join("fuzz/corpus").join(target.name);
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files.iter().map(|file| (file.display().to_string(), fs::read(file).expect("a file"))).collect()
}

/// Checks an input and its allocations; stores an input that fails as `name`.
fn check(target: &FuzzTarget, bytes: &[u8], name: &dyn Fn() -> String) -> (Outcome, Allocations) {
    *reading() =
        Some(Reading { since: Instant::now(), target: target.name, bytes: bytes.to_vec() });
    let run = || {
        let (outcome, allocated) = measured(&ALLOCATOR, || (target.check)(bytes));
        assert!(allocated.peak <= MAX_HELD_BYTES, "{} bytes are held at a time", allocated.peak);
        assert!(
            allocated.total <= target.most_work,
            "{} bytes are allocated in all",
            allocated.total
        );
        (outcome, allocated)
    };
    let read = catch_unwind(AssertUnwindSafe(run));
    *reading() = None;
    read.unwrap_or_else(|panic| {
        let stored = store(target.name, bytes);
        eprintln!("{}: this input fails: {}; it is in {stored}", target.name, name());
        resume_unwind(panic)
    })
}

fn fuzz(name: &str) {
    let _alone = alone();
    watch_for_endless_inputs();
    let target = TARGETS.iter().find(|target| target.name == name).expect("a target");
    let seeds = (target.seeds)();
    let corpus = corpus(target);
    let (mut most_total, mut most_held) = (0, 0);
    let mut add = |allocated: Allocations| {
        most_total = allocated.total.max(most_total);
        most_held = allocated.peak.max(most_held);
    };
    for (file, bytes) in &corpus {
        add(check(target, bytes, &|| file.clone()).1);
    }
    for (number, bytes) in seeds.iter().enumerate() {
        let (outcome, allocated) = check(target, bytes, &|| format!("seed {number}"));
        assert_eq!(outcome, Outcome::Read, "{name}: seed {number}");
        add(allocated);
    }

    let mut inputs: Vec<&[u8]> = corpus.iter().map(|(_, bytes)| &bytes[..]).collect();
    inputs.extend(seeds.iter().map(|bytes| &bytes[..]));
    let seed = number_of("MANDELIGHT_SEED").unwrap_or(SEED);
    let count = 100 * target.hundreds * number_of("MANDELIGHT_FUZZ").unwrap_or(1) as usize;
    println!("{name}: {count} inputs of MANDELIGHT_SEED={seed}");
    let (mut read, mut last) = (0, Vec::new());
    let mut rng = Rng::with_seed(seed);
    for number in 0..count {
        let pick = |rng: &mut Rng| inputs[rng.usize(..inputs.len())];
        let (first, other) = (pick(&mut rng), pick(&mut rng));
        // Some changes are added to those of the last input that was read.
        let base = if rng.u8(..4) == 0 && !last.is_empty() { &last[..] } else { first };
        let input = mutated(target.format, &mut rng, base, other);
        let (outcome, allocated) =
            check(target, &input, &|| format!("number {number}, seed {seed}"));
        add(allocated);
        if outcome == Outcome::Read {
            read += 1;
            last = input;
        }
    }
    println!("{name}: {read} were read; most held {most_held} bytes, allocated {most_total}");
    // Changes that are all refused at once, or all read, test little.
    assert!(read * 50 > count && read * 100 < 99 * count, "{name}: {read} of {count} were read");
}

macro_rules! targets {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            fuzz(stringify!($name));
        })*

        #[test]
        fn every_target_is_tested() {
            let tested: Vec<&str> = vec![$(stringify!($name)),*];
            let all: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
            assert_eq!(tested, all);
            let hundreds: usize = TARGETS.iter().map(|target| target.hundreds).sum();
            assert!(100 * hundreds >= INPUTS, "{hundreds} hundreds");
        }
    };
}

targets! {
    document link formula png jpeg webp openexr radiance gradient gallery command_line
}

#[test]
fn every_argument_of_the_command_line_is_in_a_seed() {
    let _alone = alone();
    let seeds = (mandelight_fuzzing::target("command_line").seeds)();
    let lines: BTreeSet<String> = seeds
        .iter()
        .flat_map(|seed| {
            String::from_utf8_lossy(seed).lines().map(str::to_owned).collect::<Vec<_>>()
        })
        .collect();
    let arguments = long_arguments();
    assert!(arguments.len() > 30 && arguments.contains("--size"), "{arguments:?}");
    let missing: Vec<_> = arguments.difference(&lines).collect();
    assert!(missing.is_empty(), "in no seed: {missing:?}");
}

/// The corpus is small, and each of its folders belongs to a target that the fuzzer has too.
#[test]
fn the_corpus_is_small_and_each_target_has_a_fuzzer() {
    let _alone = alone();
    let names: BTreeSet<String> = TARGETS.iter().map(|target| target.name.to_owned()).collect();
    let folder = root().join("fuzz/corpus");
    let entries = fs::read_dir(&folder).expect("a corpus");
    let folders: BTreeSet<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(folders, names, "the folders of the corpus");
    let size =
        |target: &FuzzTarget| corpus(target).iter().map(|(_, b)| b.len() as u64).sum::<u64>();
    let bytes: u64 = TARGETS.iter().map(size).sum();
    assert!(bytes <= MAX_CORPUS_BYTES, "the corpus has {bytes} bytes: minimise it");
    let sources = fs::read_dir(root().join("fuzz/fuzz_targets")).expect("the fuzzers");
    let sources: BTreeSet<String> = sources
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(sources, names, "the fuzzers");
}

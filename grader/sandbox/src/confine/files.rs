//! Access to files, by Landlock (<https://docs.kernel.org/userspace-api/landlock.html>). It needs
//! no rights, holds for the superuser too, and cannot be undone.

use crate::policy::Policy;
use landlock::{
    ABI, Access, AccessFs, AccessNet, BitFlags, CompatLevel, Compatible, PathBeneath, PathFd,
    Ruleset, RulesetAttr, RulesetCreated, RulesetCreatedAttr, Scope, make_bitflags,
};
use std::path::{Path, PathBuf};

/// The newest version of Landlock whose rights are given up. An older kernel gives up those that it
/// has.
const NEWEST: ABI = ABI::V6;

/// Denies all access to files that `policy` does not list, TCP, and signals and abstract sockets of
/// programs outside. A kernel without Landlock denies nothing.
pub(super) fn restrict(policy: &Policy) -> Result<(), String> {
    let failed = |e: landlock::RulesetError| format!("Landlock: {e}");
    let mut rules = Ruleset::default()
        .set_compatibility(CompatLevel::BestEffort)
        .handle_access(AccessFs::from_all(NEWEST))
        .and_then(|rules| rules.handle_access(AccessNet::from_all(NEWEST)))
        .and_then(|rules| rules.scope(Scope::from_all(NEWEST)))
        .and_then(Ruleset::create)
        .map_err(failed)?;
    let read = make_bitflags!(AccessFs::{ReadFile | ReadDir});
    let granted = [
        (&policy.read, read),
        (&policy.run, read | AccessFs::Execute),
        (&policy.write, AccessFs::from_all(NEWEST) & !devices()),
    ];
    for (paths, access) in granted {
        rules = add(rules, paths, access)?;
    }
    let status = rules.restrict_self().map_err(failed)?;
    // Without Landlock, `probe` has found other means, or nothing runs.
    let _ = status;
    Ok(())
}

/// What nobody needs to create or control in a folder of their own.
fn devices() -> BitFlags<AccessFs> {
    make_bitflags!(AccessFs::{MakeChar | MakeBlock | MakeSock | MakeFifo | IoctlDev})
}

/// Grants `access` to each of `paths` that exists.
fn add(
    mut rules: RulesetCreated,
    paths: &[PathBuf],
    access: BitFlags<AccessFs>,
) -> Result<RulesetCreated, String> {
    for path in paths {
        let Some(file) = open(path)? else {
            continue;
        };
        let access = match path.is_dir() {
            true => access,
            // The other rights make sense for folders only.
            false => access & AccessFs::from_file(NEWEST),
        };
        let added = rules.add_rule(PathBeneath::new(file, access));
        rules = added.map_err(|e| format!("Landlock, {}: {e}", path.display()))?;
    }
    Ok(rules)
}

fn open(path: &Path) -> Result<Option<PathFd>, String> {
    match (PathFd::new(path), path.exists()) {
        (Ok(file), _) => Ok(Some(file)),
        (Err(_), false) => Ok(None),
        (Err(e), true) => Err(format!("cannot open {}: {e}", path.display())),
    }
}

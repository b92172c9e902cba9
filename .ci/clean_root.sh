# Sourced by scripts that run something in a clean Debian: an empty home, nothing downloaded before. What a full ~/.cargo
# hides shows there. The toolchain is this machine's, read-only.

# Needs Linux, the superuser, `debootstrap` and a network. The Debian is made once, in FIRSTLIGHT_CLEAN_ROOT; new_root
# copies it.
clean_debian=${FIRSTLIGHT_CLEAN_ROOT:-/var/tmp/first-light-clean-root}

# Ends the script with 77, which .ci/nightly counts as skipped, where a clean root cannot be made.
need_clean_root() {
    if [ "$(id -u)" != 0 ] || ! command -v debootstrap unshare > /dev/null; then
        echo "a clean root needs Linux, the superuser, debootstrap and unshare" >&2
        exit 77
    fi
    [ ! -e "$clean_debian/etc/debian_version" ] || return 0
    rm -rf "$clean_debian.new"
    if ! debootstrap --variant=minbase --include=ca-certificates,gcc,libc6-dev,git,python3 \
        bookworm "$clean_debian.new" > "$clean_debian.log"; then
        echo "debootstrap failed (no network?): $clean_debian.log" >&2
        exit 77
    fi
    mv "$clean_debian.new" "$clean_debian"
}

# Makes the folder $1 a clean root.
new_root() {
    cp -a "$clean_debian" "$1"
    mkdir -p "$1/opt/rust"
    cp -L /etc/resolv.conf "$1/etc/resolv.conf"
    # The certificates of this machine: its network may have one of its own.
    cp -L "${SSL_CERT_FILE:-/etc/ssl/certs/ca-certificates.crt}" "$1/etc/ssl/certs/ca-certificates.crt"
}

# inside ROOT online|offline SCRIPT [NAME=VALUE...]: runs a bash script in a clean root, with a network or without. What
# it mounts and starts is gone when it ends.
inside() {
    local root=$1 network=$2 script=$3
    shift 3
    local spaces=(--mount --pid --fork --kill-child)
    [ "$network" = online ] || spaces+=(--net)
    unshare "${spaces[@]}" bash -euc '
        mount --bind "$1" "$1"
        mount -t proc proc "$1/proc"
        mount --rbind /dev "$1/dev"
        mount --bind -o ro "$2" "$1/opt/rust"
        root=$1
        shift 2
        exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 \
            PATH=/opt/rust/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
    ' unshare "$root" "$(rustc --print sysroot)" "$@" bash -euc "$script"
}

#!/bin/sh
# Installs the Debian packages that are missing, says which, and asks for rights only when it must.
# usage: packages.sh PACKAGE[,OTHER]...      OTHER where the system's archive does not have PACKAGE
available() { LC_ALL=C apt-cache policy "$1" 2>/dev/null | grep -q 'Candidate: [0-9]'; }
installed() { dpkg -s "$1" 2>/dev/null | grep -q '^Status: install ok installed'; }

missing() {
    for word in "$@"; do
        package=${word%%,*}
        installed "$package" || available "$package" || package=${word##*,}
        installed "$package" || printf ' %s' "$package"
    done
}

packages=$(missing "$@")
[ -z "$packages" ] && exit 0
echo "missing packages:$packages"
command -v apt-get >/dev/null || {
    echo "apt-get was not found: install the development files of these libraries by your system's own means" >&2
    exit 1
}
as_root=""
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || {
        echo "installing packages needs root rights, and there is no sudo; as root, run:" >&2
        echo "    apt-get install$packages" >&2
        exit 1
    }
    as_root=sudo
fi
log=$(mktemp)
done=$(mktemp)
# What apt does, a line for every tenth step: a silent minute looks like one that hangs.
told() {
    tee -a "$log" | awk '
        /^Hit:|^Get:/ && !/ Packages / { word = "fetched" } /^Get:/ { n++; name = $5 }
        /^Unpacking/ { word = "unpacked"; n++; name = $2 } /^Setting up/ { word = "set up"; n++; name = $3 }
        n >= last + 10 { printf "  %s %s\n", word, name; fflush(); last = n }'
}
echo "reading the lists of packages"
{
    $as_root apt-get update -q 2>&1 && packages=$(missing "$@") &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $packages 2>&1 && echo good >"$done"
} | told
if [ -s "$done" ]; then
    rm -f "$log" "$done"
    echo "installed"
    exit 0
fi
rm -f "$done"
tail -n 15 "$log" >&2
rm -f "$log"
echo "the packages could not be installed; run:  apt-get update && apt-get install$packages" >&2
exit 1

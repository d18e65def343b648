#!/bin/sh
# Makes a Debian machine ready to build Faintline: installs the packages that are missing, and where no Qwt for Qt 6 is
# installed, lays the source of Qwt into build/qwt/source. Where all is there, needs neither the network nor root.
# setup.sh [PACKAGE …]: packages that would be good to have besides; that they cannot be had is no failure.
set -eu

cd "$(dirname "$0")/.."

packages="g++ cmake ninja-build pkgconf dpkg-dev file
    qt6-base-dev qt6-svg-dev
    libfftw3-dev libeigen3-dev libsndfile1-dev nlohmann-json3-dev nettle-dev
    libboost-dev librandom123-dev libcli11-dev libbenchmark-dev
    libhdf5-dev liblz4-dev libsqlite3-dev librtaudio-dev libpulse-dev python3-dev pybind11-dev python3-numpy
    vamp-plugin-sdk vamp-examples"

mkdir -p build
log=$PWD/build/setup.log
: >"$log"

fail() {
    echo "error: set-up: $1" >&2
    exit 1
}

# Runs a command in silence; its words are worth reading only when it fails.
quietly() {
    "$@" >>"$log" 2>&1 </dev/null
}

whatAptSaid() {
    grep '^E' "$log" | tail -n 3 >&2 || true
}

isInstalled() {
    case $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) in
    installed*) return 0 ;;
    *) return 1 ;;
    esac
}

installPackages() {
    missing=
    for package in $packages; do
        isInstalled "$package" || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    [ "$(id -u)" -eq 0 ] || fail "packages are missing; install them as root with: apt-get install$missing"

    echo "Installing$missing"
    export DEBIAN_FRONTEND=noninteractive
    # An unrelated archive may be out of reach: whether what we need was reached, the installation tells.
    quietly apt-get update || true
    # shellcheck disable=SC2086 # one word per package
    quietly apt-get install --yes --no-install-recommends -o DPkg::Lock::Timeout=300 $missing || {
        whatAptSaid
        fail "packages could not be installed:$missing (the whole story: $log)"
    }
}

# What cannot be had is asked for once.
wishFor() {
    missing=
    for package in "$@"; do
        isInstalled "$package" || [ -e "build/setup.$package.missed" ] || missing="$missing $package"
    done
    [ -n "$missing" ] && [ "$(id -u)" -eq 0 ] || return 0
    echo "Installing$missing, if it can be had"
    export DEBIAN_FRONTEND=noninteractive
    quietly apt-get update || true
    for package in $missing; do
        quietly apt-get install --yes --no-install-recommends -o DPkg::Lock::Timeout=300 "$package" || touch "build/setup.$package.missed"
    done
}

# The machine's "deb" lines, one stanza each.
listEntries() {
    cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null | awk '
        $1 == "deb" {
            sub(/#.*/, "")
            signedBy = match($0, /signed-by=[^] \t]+/) ? substr($0, RSTART + 10, RLENGTH - 10) : ""
            sub(/\[[^]]*\]/, "")
            print "Types: deb\nURIs: " $2 "\nSuites: " $3
            $1 = $2 = $3 = ""
            print "Components: " $0
            if (signedBy != "") print "Signed-By: " signedBy
            print ""
        }' || true
}

# The machine's stanzas.
stanzaEntries() {
    for stanzas in /etc/apt/sources.list.d/*.sources; do
        [ -e "$stanzas" ] && cat "$stanzas" && echo
    done
}

# The machine's own entry for Debian's main archive, asking for the sources of another suite. Fields that would weaken
# apt's verification are not carried over.
sourceEntry() { # SUITE
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-sid}")
    { listEntries; stanzaEntries; } | awk -v codename="$codename" -v suite="$1" '
        BEGIN { RS = ""; FS = "\n" }
        function has(name, word,    words) {
            words = value[name] " "
            gsub(/[ \t\n]+/, " ", words)
            return index(words, " " word " ")
        }
        {
            split("", value)
            name = ""
            for (i = 1; i <= NF; ++i) {
                if ($i ~ /^#/) continue
                if ($i ~ /^[^ \t]/) {
                    colon = index($i, ":")
                    name = tolower(substr($i, 1, colon - 1))
                    value[name] = " " substr($i, colon + 1)
                } else
                    value[name] = value[name] "\n" $i
            }
            rolling = has("suites", "stable") || has("suites", "testing") || has("suites", "unstable") || has("suites", "sid")
            if (!has("types", "deb") || !has("components", "main") || has("enabled", "no")) next
            if (!has("suites", codename) && !(rolling && value["uris"] ~ /debian/)) next
            if (value["uris"] ~ /security/) next
            print "Types: deb-src\nURIs:" value["uris"] "\nSuites: " suite "\nComponents: main"
            if ("signed-by" in value) print "Signed-By:" value["signed-by"]
            print ""
        }'
}

# apt for one suite's sources, with lists of its own; the machine's lists stay as they are.
aptFrom() { # FOLDER, then the words for apt-get
    folder=$1
    shift
    quietly apt-get -o Dir::Etc::SourceList="$folder/qwt.sources" -o Dir::Etc::SourceParts=- \
        -o Dir::State::Lists="$folder/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
        -o APT::Default-Release= "$@"
}

fetchQwt() { # SUITE
    folder=$work/$1
    mkdir -p "$folder/lists/partial" build/qwt
    sourceEntry "$1" >"$folder/qwt.sources"
    [ -s "$folder/qwt.sources" ] || return 1
    aptFrom "$folder" update || true # again, the download tells
    (cd "$folder" && aptFrom "$folder" source --download-only --tar-only qwt) || return 1

    rm -rf build/qwt/unpacked
    mkdir build/qwt/unpacked
    tar -xf "$folder"/qwt_*.orig.tar.* -C build/qwt/unpacked --strip-components=1
    rm -rf build/qwt/source
    mv build/qwt/unpacked build/qwt/source # whole or not at all
}

provideQwt() {
    # Depth 1: Qwt's own pkg-config file asks for Qt 5 even when it was built for Qt 6.
    pkg-config --maximum-traverse-depth=1 --exists Qt6Qwt6 2>/dev/null && return 0
    [ ! -e build/qwt/source/src/qwt_plot.h ] || return 0

    echo "Fetching the source of Qwt"
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    chmod 755 "$work" # apt reads it as a user of its own
    # Not trixie: its Qwt is older than Qt 6.
    for suite in forky sid; do
        fetchQwt "$suite" && return 0
    done
    whatAptSaid
    fail "the machine's Debian archive gave no Qwt for Qt 6 (forky, sid); unpack Qwt 6.2 or later into build/qwt/source"
}

if ! command -v dpkg-query >/dev/null; then
    echo "Not Debian: the equivalents of these packages must be there, and Qwt for Qt 6: $packages" >&2
    exit 0
fi
installPackages
provideQwt
wishFor "$@"

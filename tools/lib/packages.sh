# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Checks the system and installs what is missing of tools/packages.txt by apt.
#
# Failure: another system, no apt, no rights or no network each end in one line that says what to do.

os_release=${BONDLAB_OS_RELEASE:-/etc/os-release}

# packages: the names in packages.txt, one a line.
packages() {
  sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$root/tools/packages.txt"
}

# os_value KEY: a value of os-release without its quotes.
os_value() {
  if [ -f "$os_release" ]; then
    sed -n "s/^$1=//p" "$os_release" | tr -d '"' | head -n 1
  fi
}

# Anything that is not Debian 12 or newer may still build, but not by this script's hand.
check_system() {
  local id version name
  id=$(os_value ID)
  version=$(os_value VERSION_ID)
  name=$(os_value PRETTY_NAME)
  if [ "$id" != debian ]; then
    die "this is ${name:-an unknown system}, packages are installed on Debian 12 only: install" \
      "what tools/packages.txt names, set BONDLAB_LIGGGHTS_SOURCE to a LIGGGHTS-PUBLIC 3.8 tree" \
      "and run tools/setup --no-packages"
  fi
  # Testing and unstable carry no number; they are newer.
  if [ -n "$version" ] && [ "${version%%.*}" -lt 12 ]; then
    die "this is $name, Debian 12 or newer is needed: upgrade, or install what" \
      "tools/packages.txt names and run tools/setup --no-packages"
  fi
  if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
    die "apt-get is not there: install what tools/packages.txt names and run" \
      "tools/setup --no-packages"
  fi
}

missing_packages() {
  local installed
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null |
    awk '$2 == "installed" { print $1 }')
  packages | while read -r name; do
    if ! grep -qxF -- "$name" <<< "$installed"; then echo "$name"; fi
  done
}

network_trouble() {
  grep -qE "Could not resolve|Temporary failure resolving|Could not connect|Unable to connect|Connection (refused|timed out|failed)|Network is unreachable|Cannot initiate the connection" "$log"
}

install_packages() {
  local missing as_root
  missing=$(missing_packages | tr '\n' ' ')
  missing=${missing% }
  if [ -z "$missing" ]; then return; fi

  local line="apt-get install --no-install-recommends $missing"
  if [ "$(id -u)" = 0 ]; then
    as_root=(env)
  elif command -v sudo > /dev/null && { sudo -n true 2> /dev/null || [ -t 0 ]; }; then
    # On a terminal sudo asks for the password, once, before the output goes to the log.
    sudo -v || die "sudo was refused; as root run: $line"
    as_root=(sudo env)
  else
    die "packages are missing; as root run: $line"
  fi

  note "installing: $missing"
  local apt=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=2)
  # A broken foreign source must not stop us: what counts is whether the install succeeds.
  quietly "${apt[@]}" update || true
  # shellcheck disable=SC2086  # a list of names
  if ! quietly "${apt[@]}" install -y --no-install-recommends $missing; then
    if network_trouble; then
      die "no network: apt cannot reach its mirror; connect, or as root run: $line (log: $log)"
    fi
    die "apt could not install the packages: $(reason) (log: $log)"
  fi
}

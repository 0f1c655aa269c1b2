#!/usr/bin/env bash
# Installs the packages into a fresh Debian tree, runs the service's command there, and purges them again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

readonly PACKAGES=$PWD/build/release/packages
readonly TREE=${SEEKER_CHECK_TREE:-$PWD/build/release/check-tree}
readonly START_S=60
failed=0

if [[ ${1-} == --help ]]; then
  cat <<'TEXT'
./run package --check: lintian finds no error in the packages; in a fresh Debian 12 tree (debootstrap, as root) they
install, `systemd-analyze verify` is silent, the service's command runs over an emulated robot and `seeker status`
answers, and purging them leaves nothing but the state. SEEKER_CHECK_TREE names the folder of the tree, which is kept as
FOLDER.tar for the next time.
TEXT
  exit 0
fi

skip() {
  echo "SKIPPED: $*"
  exit 0
}

# expect WHAT COMMAND...: says whether it holds, with what the command printed where it does not.
expect() {
  local what=$1
  shift
  # Not in a shell of its own: what it starts is to be stopped by this one.
  if "$@" >"$TREE.output" 2>&1; then
    echo "ok      $what"
  else
    echo "FAILED  $what"
    cat "$TREE.output"
    failed=1
  fi
}

in_tree() { chroot "$TREE" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }

mount_all() { mount -t proc proc "$TREE/proc"; }
unmount_all() { if mountpoint -q "$TREE/proc"; then umount "$TREE/proc"; fi; }

started=()
clean_up() {
  local process
  for process in "${started[@]}"; do
    kill "$process" 2>/dev/null || true
  done
  unmount_all
}

# Debian's own packages that ours need, and what the checks use; with the machine's sources.
make_tree() {
  local needs
  if [[ ! -e $TREE.tar ]]; then
    debootstrap --variant=minbase --include=ca-certificates bookworm "$TREE.new" "${SEEKER_CHECK_MIRROR:-http://deb.debian.org/debian}"
    tar -C "$TREE.new" -cf "$TREE.tar.part" .
    mv "$TREE.tar.part" "$TREE.tar"
    rm -rf "$TREE.new"
  fi
  rm -rf "$TREE"
  mkdir -p "$TREE/packages"
  tar -C "$TREE" -xf "$TREE.tar"
  rm -f "$TREE/etc/apt/sources.list"
  cp -r /etc/apt/sources.list /etc/apt/sources.list.d /etc/apt/apt.conf.d /etc/apt/trusted.gpg.d "$TREE/etc/apt/" 2>/dev/null || true
  cp /etc/resolv.conf "$TREE/etc/resolv.conf"
  cp "$PACKAGES"/*.deb "$TREE/packages/"
  mount_all
  needs=$(for deb in "$PACKAGES"/*.deb; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' | sed 's/^ *//; /^seeker-/d; /^$/d' | sort -u | paste -sd,)
  in_tree apt-get -q update
  in_tree apt-get -q satisfy --yes --no-install-recommends "$needs, systemd, udev, man-db, bash-completion"
}

# Every file of the tree but what lies outside any installation.
files_of_tree() {
  find "$TREE" \( -path "$TREE/proc" -o -path "$TREE/packages" -o -path "$TREE/tmp" -o -path "$TREE/run" -o -path "$TREE/sys" \) -prune \
    -o -print | sed "s|^$TREE||" | sort
}

install_packages() { in_tree sh -c 'dpkg --install /packages/*.deb'; }

purge_packages() { in_tree dpkg --purge seeker-server seeker-client seeker-lab seeker-data seeker-doc; }

lint_packages() {
  local report
  report=$(lintian --allow-root --fail-on none "$PACKAGES"/*.deb 2>&1)
  printf '%s\n' "$report" | tee "$PACKAGES/lintian.txt"
  ! grep -q '^E:' <<<"$report"
}

verify_is_silent() {
  local report
  report=$(in_tree systemd-analyze verify seekerd.service 2>&1) || true
  printf '%s\n' "$report"
  [[ -z $report ]]
}

udev_rules_are_inert() {
  ! grep -vE '^(#|$|ACTION=="remove", GOTO|SUBSYSTEM!="tty", GOTO|LABEL=)' "$TREE/lib/udev/rules.d/60-seeker.rules"
}

user_is_there() {
  [[ $(in_tree id -nG seeker | tr ' ' '\n' | sort | paste -sd' ') == "dialout seeker video" ]]
}

pages_are_there() {
  local program
  for program in seekerd seeker seeker-lab seeker-emulator; do
    in_tree man --warnings "$program" | grep OPTIONS || return 1
    in_tree bash -c "source /usr/share/bash-completion/completions/$program && complete -p $program" || return 1
  done
}

# as_seeker COMMAND...: as the unit runs it, in the background, with its output in $TREE/tmp/NAME.log.
as_seeker() {
  local name=$1
  shift
  chroot "$TREE" /usr/bin/setpriv --reuid=seeker --regid=seeker --init-groups --no-new-privs \
    /usr/bin/env -i PATH=/usr/bin:/bin STATE_DIRECTORY=/var/lib/seeker "$@" >"$TREE/tmp/$name.log" 2>&1 &
  started+=($!)
}

# wait_for CONDITION: a line of shell.
wait_for() { timeout "$START_S" bash -c "until $1; do sleep 0.5; done"; }

# serve_with NAME < ROBOT_FILE: the command of the unit with this robot file; its status is in $TREE/tmp/NAME.status.
serve_with() {
  local name=$1 command
  cat >"$TREE/etc/seeker/robot.yaml"
  read -ra command < <(sed -n 's/^ExecStart=//p' "$TREE/lib/systemd/system/seekerd.service")
  as_seeker "$name" "${command[@]}" --port 0 --port-file "/tmp/$name.port"
  wait_for "[[ -s $TREE/tmp/$name.port ]]" || { cat "$TREE/tmp/$name.log"; return 1; }
  # Devices need a moment: until then the status names them as silent.
  wait_for "chroot '$TREE' seeker --robot '127.0.0.1:$(<"$TREE/tmp/$name.port")' status >'$TREE/tmp/$name.status' 2>&1 &&
            ! grep -q fault '$TREE/tmp/$name.status'" || { cat "$TREE/tmp/$name.status" "$TREE/tmp/$name.log"; return 1; }
  grep 'not armed' "$TREE/tmp/$name.status"
}

# One simulated world: a robot for `driver: emulator`, whose devices a `driver: hardware` finds on lines as well.
start_emulator() {
  install -d -o "$(in_tree id -u seeker)" -g "$(in_tree id -g seeker)" -m 750 "$TREE/var/lib/seeker"
  as_seeker emulator /usr/bin/seeker-emulator --world office --robots 1 --config live --set sim.people=false --port 0 \
    --port-file /tmp/emulator.port --device p2os@tcp://127.0.0.1:0 --device lms200@tcp://127.0.0.1:0 \
    --devices-file /tmp/devices
  wait_for "[[ -s $TREE/tmp/emulator.port && -s $TREE/tmp/devices ]]" || { cat "$TREE/tmp/emulator.log"; return 1; }
}

service_answers() {
  serve_with emulated <<TEXT
base: /usr/share/seeker/config/robots/sim.yaml
robot_id: emulated
driver: emulator
emulator: {address: "127.0.0.1:$(<"$TREE/tmp/emulator.port")"}
TEXT
}

drivers_answer() {
  serve_with pioneer <<TEXT
base: /usr/share/seeker/config/robots/pioneer3dx_lms200.yaml
hardware:
  base: {port: "$(sed -n 's/^p2os //p' "$TREE/tmp/devices")"}
  lidar: {port: "$(sed -n 's/^lms200 //p' "$TREE/tmp/devices")"}
TEXT
}

delivered_file_works() {
  local config
  config=$(in_tree seekerd --config /etc/seeker/robot.yaml --print-config)
  grep '^robot_id: "robot-1"' <<<"$config" && grep '^driver: "sim"' <<<"$config"
}

# Nothing is left but the state, and the user who owns it.
nothing_is_left() {
  files_of_tree >"$TREE/tmp/after"
  local left
  left=$(comm -13 "$TREE/tmp/before" "$TREE/tmp/after" | grep -vE '^/var/lib/seeker(/|$)|^/etc/(passwd|group|shadow|gshadow|subuid|subgid)-$|^/var/(cache/man|log)/' || true)
  printf '%s\n' "$left"
  [[ -z $left ]]
}

command -v debootstrap >/dev/null || skip "there is no debootstrap; ./run install-deps --all installs it"
((EUID == 0)) || skip "only root can make a tree to install into"
compgen -G "$PACKAGES/*.deb" >/dev/null || skip "there are no packages; ./run package makes them"
trap clean_up EXIT
mkdir -p "$(dirname "$TREE")"
make_tree >"$TREE.log" 2>&1 || { tail -30 "$TREE.log"; skip "no fresh Debian tree could be made (log: $TREE.log)"; }
mkdir -p "$TREE/tmp" && chmod 1777 "$TREE/tmp"
files_of_tree >"$TREE/tmp/before"
expect "lintian finds no error" lint_packages
expect "the packages install" install_packages
expect "systemd-analyze verify is silent" verify_is_silent
expect "the user is in dialout and video" user_is_there
expect "the udev rules name no device before somebody enables them" udev_rules_are_inert
expect "manual pages and completions are there" pages_are_there
expect "the robot file as delivered is a simulated robot" delivered_file_works
in_tree systemctl enable seekerd.service >/dev/null 2>&1
expect "a simulated world is there" start_emulator
expect "the service's command runs over the emulator, and seeker status answers" service_answers
expect "the service's command runs over emulated devices, and seeker status answers" drivers_answer
cat "$TREE"/tmp/*.status 2>/dev/null || true
for process in "${started[@]}"; do
  kill "$process" && wait "$process" || true
done
started=()
expect "purging works" purge_packages
expect "nothing is left but the state" nothing_is_left
exit "$failed"

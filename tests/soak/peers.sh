#!/usr/bin/env bash
# Third parties judge the links: openssl and testssl.sh the TLS side, tc netem a bad network. Called by ./run soak peers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/support/processes.sh

failures=0
site=$server_folder/site
out=build/soak/peers
OPERATOR=${OPERATOR:-build/dev/bin/soak_operator}
WIRE=${WIRE:-build/dev/bin/soak_wire}
mkdir -p "$out"

# verdict TEXT CODE: 0 is good.
verdict() {
  if (($2 == 0)); then
    echo "  ok    $1"
  else
    echo "  FAIL  $1"
    failures=$((failures + 1))
  fi
}

# A robot at this address that shows its certificate and shuts nobody out; `settings` are its options.
make_robot() {
  local robot=$site/bundles/sim-1
  make_site "$site" "$1"
  mapfile -t settings < <(tls_settings "$robot" "revocations=$robot/crl.pem" lockout.loopback=false)
}

# s_client OPTIONS...: OpenSSL's client with the operator's certificate; what is typed comes from stdin.
s_client() {
  local anna=$site/bundles/anna
  timeout 10 openssl s_client -connect "127.0.0.1:$server_port" -CAfile "$anna/ca.pem" -cert "$anna/cert.pem" \
    -key "$anna/key.pem" -verify_return_error -verify_ip 127.0.0.1 "$@" 2>&1
}

# handshakes OPTIONS...: whether a handshake with them succeeds.
handshakes() { s_client "$@" </dev/null | grep -q 'Verification: OK'; }

refuses() { ! handshakes "$@"; }

judge_versions() {
  local version suite code
  echo "openssl s_client: versions and ciphers"
  for version in -tls1 -tls1_1 -tls1_2; do
    code=0
    refuses "$version" -cipher ALL:@SECLEVEL=0 || code=1
    verdict "${version#-} is refused" "$code"
  done
  code=0
  handshakes -tls1_3 || code=1
  verdict "tls1_3 is spoken" "$code"
  for suite in TLS_AES_256_GCM_SHA384 TLS_CHACHA20_POLY1305_SHA256 TLS_AES_128_GCM_SHA256 TLS_AES_128_CCM_SHA256 \
    TLS_AES_128_CCM_8_SHA256; do
    if handshakes -tls1_3 -ciphersuites "$suite"; then
      echo "  info  $suite is offered"
      [[ $suite != *_CCM_8_* ]] || verdict "a cipher with a short tag is offered" 1
    else
      echo "  info  $suite is not offered"
    fi
  done
}

judge_session() {
  local session=$server_folder/session text code
  echo "openssl s_client: certificates, resumption, early data, renegotiation"
  text=$(timeout 10 openssl s_client -connect "127.0.0.1:$server_port" -CAfile "$site/ca.pem" -tls1_3 \
    -ign_eof 2>&1 </dev/null || true)
  code=0
  grep -q 'alert certificate required' <<<"$text" || code=1
  verdict "without a certificate: 'certificate required'" "$code"
  text=$( (sleep 1) | s_client -tls1_3 -sess_out "$session" || true)
  code=0
  [[ ! -s $session ]] && ! grep -q 'Post-Handshake New Session Ticket arrived' <<<"$text" || code=1
  verdict "no session ticket is given: nothing to resume" "$code"
  code=0
  grep -q 'Early data was not sent' <<<"$text" && ! grep -qE 'Max Early Data: [1-9]' <<<"$text" || code=1
  verdict "no early data" "$code"
  code=0
  grep -q 'Compression: NONE' <<<"$text" && grep -q 'Secure Renegotiation IS NOT supported' <<<"$text" || code=1
  verdict "no compression, no renegotiation (there is none in TLS 1.3)" "$code"
  code=0
  text=$( (sleep 1; echo R; sleep 1) | s_client -tls1_3 || true)
  ! grep -q 'RENEGOTIATING.*verify return:1' <<<"$(tr '\n' ' ' <<<"$text")" || code=1
  verdict "a renegotiation that is asked for does not take place" "$code"
}

# testssl.sh shows no certificate of its own, but it calls the openssl that it is given: this one adds the operator's.
make_openssl() {
  local file=$server_folder/openssl anna
  anna=$(realpath "$site/bundles/anna")
  cat >"$file" <<SCRIPT
#!/bin/sh
verb=\$1
if [ "\$verb" = s_client ]; then
  shift
  exec /usr/bin/openssl s_client -cert '$anna/cert.pem' -key '$anna/key.pem' "\$@"
fi
exec /usr/bin/openssl "\$@"
SCRIPT
  chmod +x "$file"
  echo "$file"
}

# What testssl.sh says of every site with a CA of its own, and why that is meant.
declare -A meant=(
  [cert_revocation]="the list of revocations is a file of the site that its robots have; no address on the net is named"
  [DNS_CAArecord]="a robot has an address and no domain"
)

# judge_testssl NAME OPTIONS...: nothing worse than informational is found, but for what is meant. WARN says what the
# tool could not try: the other run does.
judge_testssl() {
  local name=$1 json=$out/testssl-$1.json code=0 worse
  shift
  rm -f "$json"
  timeout 900 testssl --quiet --warnings off --color 0 --nodns none --add-ca "$site/ca.pem" --jsonfile "$json" "$@" \
    "127.0.0.1:$server_port" >"$out/testssl-$name.txt" 2>&1 || code=$?
  [[ -s $json ]] || { verdict "testssl.sh ($name) gave no report (code $code): $out/testssl-$name.txt" 1; return; }
  worse=$(testssl_worse "$json")
  echo "  info  testssl.sh ($name): $(grep -c '"severity"' "$json") findings, code $code"
  local id rest found=0
  while read -r id rest; do
    [[ -n $id ]] || continue
    if [[ -n ${meant[$id]-} ]]; then
      echo "  info  $id: $rest; ${meant[$id]}"
    else
      echo "  bad   $id: $rest"
      found=1
    fi
  done <<<"$worse"
  verdict "testssl.sh ($name) finds nothing else that is worse than informational" "$found"
}

# Lines "id finding (severity)" of what is worse than informational.
testssl_worse() {
  awk -F'"' '
    /"id"/ { id = $4 }
    /"severity"/ { severity = $4 }
    /"finding"/ { if (severity !~ /^(OK|INFO|DEBUG|WARN)$/) print id, $4 " (" severity ")" }' "$1"
}

judge_tls() {
  local settings
  make_robot 127.0.0.1
  start_server "$out/server.log" --config config/robots/sim.yaml "${settings[@]}"
  judge_versions
  judge_session
  echo "testssl.sh"
  judge_testssl with-certificate --openssl "$(make_openssl)" --ssl-native -p -P -E -S -U
  judge_testssl without-certificate -p -P -E -U
  stop_server
  verdict "the robot has gone through it and ends orderly" "$server_code"
}

namespaces=("seeker-robot-$$" "seeker-operator-$$")
wire_pid=
remove_network() {
  local one
  stop_process "$wire_pid"
  wire_pid=
  for one in "${namespaces[@]}"; do
    ip netns del "$one" 2>/dev/null || true
  done
}
stop_all() {
  remove_network
  stop_server
}

# Two namespaces; says why not and fails where they cannot be made.
make_namespaces() {
  local why one
  ((EUID == 0)) || { echo "only root may make network namespaces"; return 1; }
  for one in "${namespaces[@]}"; do
    why=$(ip netns add "$one" 2>&1) || { echo "no namespace can be made here: $why"; return 1; }
    ip -n "$one" link set lo up
  done
}

# A pair of devices that tc netem makes bad. Fails where the kernel has no netem.
lay_cable() {
  local side
  ip link add cable0 netns "${namespaces[0]}" type veth peer name cable1 netns "${namespaces[1]}" || return 1
  for side in 0 1; do
    ip netns exec "${namespaces[$side]}" tc qdisc add dev "cable$side" root netem \
      delay "${delay_ms}ms" loss "$loss_percent%" rate "${rate_kbit}kbit" 2>/dev/null || return 1
  done
}

has_device() { ip -n "$1" link show "$2" >/dev/null 2>&1; }

# The same by a program of ours, packet by packet.
lay_own_cable() {
  local side
  ip -n "${namespaces[0]}" link del cable0
  "$WIRE" "${namespaces[@]}" "$delay_ms" "$loss_percent" "$rate_kbit" "$seed" &
  wire_pid=$!
  for side in 0 1; do
    wait_until 50 has_device "${namespaces[$side]}" "cable$side" || return 1
  done
}

use_cable() {
  local side
  for side in 0 1; do
    ip -n "${namespaces[$side]}" addr add "$network.$((side + 1))/24" dev "cable$side"
    ip -n "${namespaces[$side]}" link set "cable$side" up
  done
}

# A mission is commanded, followed and stopped over a network of 200 ms, 5 % loss and 256 kbit/s.
judge_bad_network() {
  local network=10.213.74 delay_ms=100 loss_percent=5 rate_kbit=256 seed=${SEED:-1} code=0 why settings
  echo "two hosts, ${delay_ms} ms each way, $loss_percent % loss, $rate_kbit kbit/s, seed $seed"
  why=$(make_namespaces) || { echo "  skip  $why"; remove_network; return 0; }
  if lay_cable; then
    echo "  info  by tc netem"
  else
    echo "  skip  tc netem: this kernel has none (CONFIG_NET_SCH_NETEM); a program of ours does the same instead"
    lay_own_cable || { echo "  skip  and no TUN device can be made"; remove_network; return 0; }
  fi
  use_cable
  rm -rf "$site"
  make_robot "$network.1"
  SEEKERD="ip netns exec ${namespaces[0]} $SEEKERD" start_server "$out/network-server.log" \
    --config config/robots/live.yaml --set "server.address=$network.1" --set sim.people=false "${settings[@]}"
  ip netns exec "${namespaces[1]}" "$OPERATOR" "$network.1:$server_port" "$site/bundles/anna" || code=$?
  verdict "missions are commanded, followed and stopped; STOP takes a round trip and a period of the loop in all but one" "$code"
  stop_server
  remove_network
}

[[ ${1-} == network ]] || judge_tls
judge_bad_network
((failures == 0)) || { echo "$failures verdicts are bad"; exit 1; }
echo "no verdict is bad"

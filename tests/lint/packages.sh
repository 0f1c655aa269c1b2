# shellcheck shell=bash
# Debian packages by purpose, and how they get onto the machine. Sourced by ./run.

declare -A PACKAGES=(
  [base]="g++ cmake ninja-build pkg-config ccache mold libboost1.81-dev libeigen3-dev libexpected-dev libopencv-core-dev
    libopencv-imgproc-dev libopencv-features2d-dev libopencv-flann-dev libopencv-calib3d-dev libopencv-videoio-dev libprotobuf-dev
    protobuf-compiler libfuzzylite-dev libnanoflann-dev libyaml-cpp-dev libcli11-dev libspdlog-dev libfmt-dev
    libsqlite3-dev libsystemd-dev prometheus-cpp-dev libzstd-dev libssl-dev libpng-dev libjpeg-dev zlib1g-dev
    nlohmann-json3-dev libcairo2-dev libfreetype-dev fonts-dejavu-core"
  [test]="libgtest-dev libgmock-dev librapidcheck-dev openssl curl"
  [lint]="clang-format clang-tidy"
  [bench]="libbenchmark-dev"
  [grpc]="libgrpc++-dev protobuf-compiler-grpc"
  [fuzz]="clang-14 libfuzzer-14-dev libclang-rt-14-dev"
  [package]="dpkg-dev"
  [check]="debootstrap lintian"
  [heavy]="mrpt-apps time perl-base"
  [peers]="testssl.sh iproute2"
)

package_is_installed() {
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed* ]]
}

# Boost's versions exclude each other; 1.74 does not compile coroutines with this compiler.
refuse_old_boost() {
  if ! package_is_installed libboost1.74-dev || [[ ${CI-} == true ]]; then
    return 0
  fi
  cat >&2 <<'TEXT'
libboost1.74-dev is installed. It excludes libboost1.81-dev, which Seeker needs, and it is not removed without your word,
since other packages may stand on it. See what would go with it, then remove it:
  apt-get --simulate remove libboost1.74-dev
  sudo apt-get remove libboost1.74-dev
TEXT
  return 1
}

# need_packages PURPOSE...: installs what is missing; does nothing, and asks for nothing, when all is there.
need_packages() {
  local purpose package missing=()
  command -v dpkg-query >/dev/null || {
    echo "not a Debian system: provide the packages named in tests/lint/packages.sh yourself" >&2
    return 0
  }
  for purpose in "$@"; do
    for package in ${PACKAGES[$purpose]}; do
      package_is_installed "$package" || missing+=("$package")
    done
  done
  ((${#missing[@]} > 0)) || return 0

  local as_root=() keep=(--no-remove)
  if ((EUID != 0)); then
    as_root=(sudo -n)
    if ! sudo -n true 2>/dev/null; then
      echo "packages are missing, and this user may not install them. Please run:" >&2
      echo "  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 1
    fi
  fi
  if [[ " ${missing[*]} " == *" libboost1.81-dev "* ]]; then
    refuse_old_boost || exit 1
    [[ ${CI-} == true ]] && keep=()
  fi
  echo "installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q install --yes --no-install-recommends "${keep[@]}" "${missing[@]}"
}

#!/bin/sh
# Install boat_buoyancy into .venv beside this file, on a machine that has Python and no ROS.
# `./install.sh --help` says how. It comes to `python3 -m venv .venv && .venv/bin/pip install
# '.[ros,fast,mesh]'`, and also works with the Python of a fresh Debian or Ubuntu, which has no pip.
set -eu
cd -- "$(dirname -- "$0")"

usage() {
  cat <<'END'
Usage: ./install.sh [EXTRA,...]

Install boat_buoyancy into .venv beside this file. It touches nothing outside this folder and
needs no root. Extras, with commas between:

  ros    ROS 2 Jazzy from Python wheels, enough to run the node (the default)
  chart  the command-line tools with plots and charts; they need no ROS
  test   what the tests need
  view   the page of buoyancy_view; it needs no ROS
  fast   Numba, which compiles the step; ros, chart and view take it along
  mesh   trimesh, which reads hulls from mesh files; ros, chart and view take it along
  bem    capytaine, for buoyancy_hydrodynamics --bem
  bag    rosbags, which writes recordings (buoyancy_simulate --mcap); no ROS needed

  ./install.sh ros         the node
  ./install.sh ros,test    the node, and what the tests need
  ./install.sh chart       the physics and the command-line tools, without ROS
  ./install.sh view        the page that shows a boat and tunes it, without ROS

PYTHON=... chooses the Python, 3.10 to 3.14.
END
}

fail() {
  printf 'install.sh: %s\n' "$*" >&2
  exit 2
}

# What an active ROS or ROS venv leaves behind would be mixed into this one.
unset PYTHONPATH PYTHONHOME LD_LIBRARY_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE

# The folder or wheel of some pip on this machine that $python can import.
find_pip() {
  "$python" -c 'import os, pip; print(os.path.dirname(os.path.dirname(pip.__file__)))' \
    2>/dev/null && return
  for wheel in /usr/share/python-wheels/pip-*.whl; do
    [ -e "$wheel" ] && printf '%s\n' "$wheel" && return
  done
  # Debian's own package of pip, unpacked and not installed: that needs no root.
  (cd .venv && apt-get -q download python3-pip-whl && dpkg-deb -x python3-pip-whl_*.deb pip) \
    >/dev/null 2>&1 || return
  for wheel in "$PWD"/.venv/pip/usr/share/python-wheels/pip-*.whl; do
    [ -e "$wheel" ] && printf '%s\n' "$wheel" && return
  done
  return 1
}

extras=${1:-ros}
case $extras in
  -h|--help) usage; exit ;;
esac
[ $# -le 1 ] || fail "expected one list of extras with commas between, got '$*' (try --help)"
for extra in $(printf '%s' "$extras" | tr , ' '); do
  case $extra in
    ros|chart|view|test|fast|mesh|bem|bag) ;;
    *) fail "expected extras out of ros, chart, view, test, fast, mesh, bem and bag, got '$extra'" \
         '(try --help)' ;;
  esac
done
case ",$extras," in
  *,ros,*|*,chart,*|*,view,*)
    for extra in fast mesh; do
      case ",$extras," in *,$extra,*) ;; *) extras=$extras,$extra ;; esac
    done
    ;;
esac
# MB of each on Linux x86_64; the tests draw too.
size=105
case ",$extras," in *,ros,*) size=$((size + 165)) ;; esac
case ",$extras," in *,view,*) size=$((size + 75)) ;; esac
case ",$extras," in *,fast,*) size=$((size + 205)) ;; esac
case ",$extras," in *,mesh,*|*,test,*) size=$((size + 10)) ;; esac
case ",$extras," in *,bem,*) size=$((size + 115)) ;; esac
case ",$extras," in *,bag,*|*,test,*) size=$((size + 25)) ;; esac
case ",$extras," in
  *,test,*) size=$((size + 290)) ;;
  *,chart,*) size=$((size + 245)) ;;
  *,bem,*) size=$((size + 145)) ;;
esac
case ",$extras," in
  *,ros,*)
    [ "$(uname -s) $(uname -m)" = 'Linux x86_64' ] ||
      fail "the wheels of ROS are for Linux x86_64, this is $(uname -s) $(uname -m):" \
        'install ROS 2 Jazzy and use colcon, or ./install.sh chart for everything but the node'
    ;;
esac

for python in ${PYTHON:-python3 python3.14 python3.13 python3.12 python3.11 python3.10} ''; do
  [ -n "$python" ] || fail "needs Python 3.10 to 3.14, and ${PYTHON:-python3} is $(
    "${PYTHON:-python3}" --version 2>/dev/null || echo missing)"
  "$python" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 14))' \
    2>/dev/null && break
done

# A half-made or outdated .venv has no pip that runs: begin again.
if ! .venv/bin/python -m pip --version >/dev/null 2>&1; then
  if ! "$python" -m venv --clear .venv >/dev/null 2>&1; then
    "$python" -m venv --clear --without-pip .venv ||
      fail "$python cannot make virtual environments: install its venv module"
    pip=$(find_pip) ||
      fail "$python has neither ensurepip nor pip." \
        'On Debian and Ubuntu: sudo apt-get install python3-venv'
    PYTHONPATH=$pip .venv/bin/python -m pip install --quiet --ignore-installed pip
    rm -rf .venv/pip .venv/python3-pip-whl_*.deb
  fi
fi

echo "install.sh: installing boat_buoyancy[$extras] into .venv;" \
  "a new one takes about $size MB and a minute"
.venv/bin/python -m pip install --quiet ".[$extras]"
echo "install.sh: done, .venv takes $(du -sm .venv | cut -f1) MB"

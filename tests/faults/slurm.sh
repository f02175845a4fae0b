# A cluster of two nodes on this machine, run by Slurm's own daemons: configs/quick.json is made by
# the command `slurm`, with an element that is made to run again, one that is cancelled and a node
# that dies, and by srun; each ends with the tables and beds of one run here.
configs=$(realpath "$(dirname "$0")/../../configs")
source "$(dirname "$0")/common.sh" "$1"
PATH=$PATH:/usr/sbin
for tool in slurmctld slurmd sbatch munged; do
  command -v $tool >/dev/null || skip "$tool is not installed (setup.sh --checks installs it)"
done
unset "${!SLURM_@}" "${!SBATCH_@}"
export SLURM_CONF=$here/slurm.conf

# processes NODE: those of Slurm's jobs on that node and of what watches over them. Only its daemons
# and their children know the configuration of this test.
processes() {
  local folder
  for folder in /proc/[1-9]*; do
    grep -qzxF "SLURM_CONF=$SLURM_CONF" "$folder/environ" 2>/dev/null || continue
    grep -qzxF "SLURMD_NODENAME=$1" "$folder/environ" 2>/dev/null || continue
    echo "${folder#/proc/}"
    sed -n 's/^PPid:\t//p' "$folder/status" 2>/dev/null || true
  done | sort -u | while read -r process; do
    grep -qzxF "SLURM_CONF=$SLURM_CONF" "/proc/$process/environ" 2>/dev/null && echo "$process"
  done || true
}

# Ends a daemon by the file that holds its number, and waits until it has gone.
stop_daemon() { # SIGNAL FILE
  local process
  process=$(cat "$2" 2>/dev/null) || return 0
  kill -"$1" "$process" 2>/dev/null || true
  while is_running "$process"; do pause 20; done
  rm -f "$2"
}

clear_up() {
  local node process
  for node in n1 n2; do
    stop_daemon TERM "$here/$node.pid"
    for process in $(processes $node); do kill -KILL "$process" 2>/dev/null || true; done
  done
  stop_daemon TERM "$here/slurmctld.pid"
  stop_daemon TERM "$here/munged.pid"
  rm -rf "$here"
}
trap clear_up EXIT

give_up() {
  tail -n 20 ./*.log >&2
  squeue --array >&2 || true
  fail "$*"
}

# await WHAT CONDITION...: looks until it holds, and gives up where it never does.
await() {
  local what=$1 began=$SECONDS
  shift
  until "$@"; do
    ((SECONDS - began < 120)) || give_up "waited in vain until $what"
    pause 50
  done
}

# A port that can be bound on all addresses: others may hold one without listening on this one.
free_port() {
  /usr/bin/python3 - "$(between 20000 29000)" <<'PYTHON'
import socket, sys
for port in range(int(sys.argv[1]), 30000):
    try:
        socket.socket().bind(("", port))
    except OSError:
        continue
    print(port)
    break
PYTHON
}

configure() {
  local user host
  user=$(id -un) host=$(hostname -s)
  cat >slurm.conf <<CONF
ClusterName=private
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthInfo=socket=$here/munge.socket,cred_expire=5
StateSaveLocation=$here/state
SlurmctldPidFile=$here/slurmctld.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdPidFile=$here/%n.pid
SlurmdLogFile=$here/%n.log
SlurmdSpoolDir=$here/%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
MaxArraySize=6
ReturnToService=2
SlurmdTimeout=6
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=2 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=2 RealMemory=1000
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=2:00:00
CONF
}

idle_nodes() {
  [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null || true)" = "$1" ]
}

start_cluster() {
  configure
  head -c 128 /dev/urandom >munge.key
  chmod 600 munge.key
  chmod 711 "$here" # all may reach the socket, or munged refuses it
  munged --key-file "$here/munge.key" --socket "$here/munge.socket" --pid-file "$here/munged.pid" \
    --log-file "$here/munged.log" --seed-file "$here/munge.seed"
  mkdir state n1 n2
  slurmctld -i
  slurmd -N n1
  slurmd -N n2
  await "two nodes are idle" idle_nodes 2
}

# in_queue JOB: how many of its elements wait or run.
in_queue() {
  squeue --noheader --array --jobs="$1" --format=%T 2>/dev/null | grep -c . || true
}
is_over() { [ "$(in_queue "$1")" -eq 0 ]; }

# told ELEMENT NAME: what Slurm knows of it.
told() {
  scontrol show job "$1" 2>/dev/null | grep -o "\b$2=[^ ]*" | head -n 1 | cut -d= -f2
}

# Waits until a process that was sent SIGSTOP has stopped, which on a loaded machine takes a little;
# false if it has ended before.
is_halted() {
  local state
  while true; do
    state=$(sed -n 's/^State:\t\(.\).*/\1/p' "/proc/$1/status" 2>/dev/null) || true
    case $state in
      T) return 0 ;;
      "" | Z | X) return 1 ;;
    esac
    sleep 0.01
  done
}

# Finds an element at work that has stored a packing, and halts it, so that it cannot end before
# what it is meant for happens. Sets `element` and `runner`. ELEMENTS are those to choose from.
halt_one_of() {
  local number journal
  for number in "$@"; do
    journal=out\ dir/shards/$number-of-4.jsonl
    grep -qs '"outcome":' "$journal" || continue
    runner=$(grep '"process":' "$journal" | tail -n 1 | sed 's/.*"process":"[^"]*-\([0-9]*\)".*/\1/')
    kill -STOP "$runner" 2>/dev/null || continue
    is_halted "$runner" || continue
    element=$number
    return 0
  done
  return 1
}

has_ended() { ! is_running "$1"; }

start_cluster
run_to_the_end "$configs/quick.json" reference --threads 2
packings=$(packing_lines reference | wc -l)

expect_code 0 "$program" slurm "$configs/quick.json" --print --out "out dir" --shards 20
expect_text error.txt "Partition main: 2 nodes of 2 cores and 1.0 GB, 2 h 0 min a job, 5 elements" \
  ": 5 shards of about " "Decided by: an array has no more elements (MaxArraySize)"
expect_text out.txt "#SBATCH --array=1-5" "#SBATCH --signal=B:TERM@90" "exec $program run "
[ ! -e "out dir" ] || fail "--print wrote something"
expect_code 2 "$program" slurm "$configs/quick.json" --partition large
expect_text error.txt "--partition large: this cluster has none of that name; it has: main"

SBATCH_RESERVATION=nowhere expect_code 2 "$program" slurm "$configs/quick.json" --out refused
expect_text error.txt "sbatch: "
[ ! -e refused/slurm ] || fail "scripts stay that were refused"

expect_code 0 "$program" slurm "$configs/quick.json" --out "out dir" --shards 4
array=$(sed -n 's/^Submitted job \([0-9]*\), an array of 4 shards/\1/p' out.txt)
rest=$(sed -n 's/^Submitted job \([0-9]*\), which follows.*/\1/p' out.txt)

# One element is told to run again, one is cancelled, one loses its node. Each is halted as it comes
# to work, two at a time as the cluster has cores, before any can end.
await "an element is at work" halt_one_of 1 2 3 4
again=$element again_runner=$runner
mapfile -t others < <(seq 4 | grep -vx "$again")
await "another element is at work" halt_one_of "${others[@]}"
cancelled=$element cancelled_runner=$runner
expect_code 0 "$program" status "out dir"
expect_text out.txt "Running: host $(hostname), process " "Slurm: " " running, " "Left: about "

scontrol requeue "${array}_$again"
await "the element that is to run again has ended" has_ended "$again_runner"
mapfile -t others < <(seq 4 | grep -vx -e "$again" -e "$cancelled")
await "a third element is at work" halt_one_of "${others[@]}"
# runs_again ELEMENT
runs_again() { [ "$(told "${array}_$1" Restarts)" = 1 ]; }
await "the first is to run again" runs_again "$again"
scancel "${array}_$cancelled"
await "the cancelled element has ended" has_ended "$cancelled_runner"

node=$(told "${array}_$element" NodeList)
stop_daemon KILL "$node.pid"
for process in $(processes "$node"); do kill -KILL "$process" 2>/dev/null || true; done
await "the node's runner has ended" has_ended "$runner"
expect_code 0 "$program" status "out dir" --json
expect_text out.txt '"lost_runners": [' "process $runner ($element-of-4, silent for " '"slurm": {'
await "Slurm begins anew what the node had" runs_again "$element"

await "the array has ended" is_over "$array"
await "the rest is made" is_over "$rest"
[ -s "out dir/report.html" ] || give_up "no page: $(cat "out dir/slurm/rest.log")"
same_as_reference "out dir" "an array"

# By srun, after the node is back.
slurmd -N "$node"
await "both nodes are idle" idle_nodes 2
mkdir bin
ln -s "$program" bin/grainsweep
PATH=$here/bin:$PATH
tasks=$(sbatch --parsable --ntasks=4 --time=10:00 "$configs/cluster/srun.sh" "$configs/quick.json" tasks)
await "the tasks have ended" is_over "$tasks"
same_as_reference tasks "srun"
echo "element $again ran again, $cancelled was cancelled, $element lost $node: the tables of one run"

# peers.csv (with -F,) as markdown: a row per bed, then how many times the CPU time of each preset
# of grainsweep the others use.
NR == 1 {
  for (i = 1; i <= NF; ++i) column[$i] = i
  print "| code | setting | CPU s | overlap / d: mean | max | kinetic energy / m g d |" \
        " contacts / isostatic | at gap < 1e-4 d | phi | Z |"
  print "|---|---|---|---|---|---|---|---|---|---|"
  next
}
function value(name) { return $column[name] }
{
  setting = value("setting") (value("status") == "settled" ? "" : " (" value("status") ")")
  printf "| %s | %s | %.3g | %.1e | %.1e | %.0e | %.3f | %.3f | %.4f | %.3f |\n", value("code"),
         setting, value("cpu_seconds"), value("overlap_mean"), value("overlap_max"),
         value("kinetic_energy"), value("contacts") / value("isostatic_contacts"),
         value("contacts_near") / value("isostatic_contacts"), value("solid_fraction"),
         value("coordination")
  if (value("code") == "grainsweep") {
    own[++presets] = value("setting")
    own_seconds[presets] = value("cpu_seconds")
  } else {
    peer[++peers] = value("code") ", " value("setting")
    peer_seconds[peers] = value("cpu_seconds")
  }
}
END {
  if (!peers) exit
  printf "\n| CPU time over that of grainsweep at |"
  for (k = 1; k <= presets; ++k) printf " %s |", own[k]
  printf "\n|---|"
  for (k = 1; k <= presets; ++k) printf "---|"
  for (i = 1; i <= peers; ++i) {
    printf "\n| %s |", peer[i]
    for (k = 1; k <= presets; ++k) printf " %.1f |", peer_seconds[i] / own_seconds[k]
  }
  print ""
}

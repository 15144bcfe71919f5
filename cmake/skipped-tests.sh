# Sourced by run-tests: prints one line with the number of skipped tests and their reasons, from ctest's log.
myoid_print_skipped() {
  awk '
    /: Skipped$/ {
      getline
      sub(/^needs "[^"]*"; set MYOID_DATA.*/, "need recordings that are not here (set MYOID_DATA to their folder)")
      tests[$0]++; all++
    }
    END {
      if (!all) { print "No test was skipped."; exit }
      line = ""
      for (reason in tests) line = line (line == "" ? "" : "; ") tests[reason] ": " reason
      print "Skipped " all (all == 1 ? " test" : " tests") " (" line ")."
    }' "$MYOID_BUILD/Testing/Temporary/LastTest.log"
}

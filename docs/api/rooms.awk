# Prepares a header for Doxygen. Its names go into the group of its room: the group opens behind `namespace ... {` on the
# same line, so that lines keep their numbers. Comments are plain text: < and @ stand for themselves.
FNR == 1 {
  room = FILENAME
  sub(/^.*myoid\//, "", room)
  sub(/\/[^\/]*$/, "", room)  # the folder; of a folder in a room, such as model/opensim_defects, the room
  sub(/\/(opensim_defects|viewer)$/, "", room)
  sub(/^.*\//, "", room)
}
/^(namespace myoid[a-z_: ]*|extern "C") \{$/ { print $0 " /** @addtogroup " room " */ /** @{ */"; c = /extern/; next }
/^\}  \/\/ namespace myoid/ || (c && /^\}$/) { print "/** @} */ " $0; next }
match($0, /\/\/\/<?/) {
  text = substr($0, RSTART + RLENGTH)
  gsub(/</, "\\&lt;", text)
  gsub(/@/, "\\@", text)
  print substr($0, 1, RSTART + RLENGTH - 1) text
  next
}
{ print }

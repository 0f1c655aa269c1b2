# Reads "FILE KEY" lines in order and prints a line of tab-separated "FILE KEY" for each batch of at most `most` files that can
# be checked as one source. Of a folder a batch has ten files that follow each other, which cmake/SeekerUnity.cmake compiles as
# one, or one of the `alone` ones; and no two files give a name of their own (in an unnamed namespace, static, or main) to two
# things. A file goes into the first batch that takes it, so that neighbours, which include the same headers, come together.

# The name that a declaration at the start of a line introduces, or "".
function declared(line) {
  if (match(line, /^(struct|class|enum class|enum|union|using) [A-Za-z_]/)) {
    sub(/^(struct|class|enum class|enum|union|using) /, "", line)
    match(line, /^[A-Za-z_0-9]+/)
    return substr(line, 1, RLENGTH)
  }
  if (!match(line, /[A-Za-z_0-9]+(\(|\{| =|\[|;)/)) return ""
  line = substr(line, RSTART, RLENGTH)
  sub(/[^A-Za-z_0-9].*$/, "", line)
  return line
}

# The names of FILE's own, in names[1..], and how many.
function own_names(file, names,   line, hidden, count, name) {
  count = 0; hidden = 0
  while ((getline line < file) > 0) {
    if (line == "namespace {") { hidden = 1; continue }
    if (line ~ /^}  \/\/ namespace$/) { hidden = 0; continue }
    if (line ~ /^int main\(/ || line ~ /^static / || (hidden && line ~ /^[A-Za-z]/ && line !~ /^namespace /)) {
      name = declared(line)
      if (name != "") names[++count] = name
    }
  }
  close(file)
  return count
}

# The ten of its folder that FILE is of.
function ten_of(folder, file) {
  if (index(" " alone " ", " " file " ")) return file
  met[folder] += 1
  return int((met[folder] - 1) / 10)
}

{
  count = own_names($1, names)
  folder = $1
  sub(/\/[^\/]*$/, "", folder)
  ten = ten_of(folder, $1)
  for (batch = 1; ; ++batch) {
    clash = size[batch] >= most || ((batch, folder) in of && of[batch, folder] != ten)
    for (i = 1; i <= count && !clash; ++i) clash = (batch, names[i]) in taken
    if (!clash) break
  }
  of[batch, folder] = ten
  for (i = 1; i <= count; ++i) taken[batch, names[i]] = 1
  lines[batch] = lines[batch] (size[batch]++ ? "\t" : "") $0
  if (batch > batches) batches = batch
}
END { for (batch = 1; batch <= batches; ++batch) print lines[batch] }

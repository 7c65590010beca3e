# Prints what doxygen is to read instead of a file, line for line, so that no file has to be written for doxygen.
FNR == 1 { name = folder = FILENAME; sub(/.*\//, "", name); sub(/\/include.*/, "", folder); sub(/.*\//, "", folder) }

# Chapters: links are relative to the file, doxygen's to the repository and not in code; members are looked for in bch.
name ~ /\.md$/ {
  gsub(/\]\((\.\.\/)+/, "]("); gsub(/\[`/, "["); gsub(/`\]\(/, "](")
  while (match($0, /`[A-Z][A-Za-z]+::[a-z_]+\(\)`/)) $0 = substr($0, 1, RSTART) "bch::" substr($0, RSTART + 1)
  print
  next
}

# Examples: the comment that says what one shows, and nothing of its code.
name ~ /\.cpp$/ { print FNR == 1 ? "/** \\example " name : FNR == 2 ? "\\details" : /^\/\/ / ? substr($0, 3) : ""; next }
END { if (name ~ /\.(cpp|c)$/) print "*/" }
name ~ /\.c$/ {
  text = /^\/\* [^S].*\*\/$/ ? substr($0, 4, length($0) - 6) : ""
  print (FNR == 1 ? "/** \\example " name " \\details " : "") text
  next
}

# The C interface: each header is a module.
name ~ /\.h$/ { print FNR == 1 ? "/** \\defgroup h_" substr(name, 1, length(name) - 2) " c_api: " name : FNR == 2 ? "\\{ */" : $0; next }
END { if (name ~ /\.h$/) print "/** \\} */" }

# Headers: each is a module in the place of its first four lines. Its description is what it declares, with links but for names
# that others declare, too.
FNR == 1 {
  module = "hpp_" name; sub(/\.hpp/, "", module)
  while ((getline line < "tests/whole/public_surface.txt") > 0) {
    if (sub("^" name ": ", "", line)) count = split(line, names, " ")
    surface = surface " " line " "
  }
  for (i = 1; i <= count; ++i) {
    link = names[i] ~ /^BCH/ || split(surface, parts, " " names[i] " ") > 2 ? names[i] : "\\ref bch::" names[i] " \"" names[i] "\""
    declared = declared (i > 1 ? ", " : "") link
  }
  title["kernel"] = "kernel: queries"; title["layout"] = "layout: shapes"; title["distributed"] = "distributed: crowds on many processes"
  $0 = "/** \\file */ /** \\addtogroup " folder " " title[folder]
}
FNR == 2 { $0 = "*/ /** \\addtogroup " module " bch/" name }
FNR == 3 { $0 = "\\ingroup " folder }
FNR == 4 { $0 = (declared ? "\\brief Declares " declared : "\\brief Includes all headers") ". */" }
/^namespace bch \{$/ { $0 = $0 " /** \\addtogroup " module; opened = FNR }
opened && FNR == opened + 1 { $0 = "\\{ */" }
/^\}  \/\/ namespace bch$/ { $0 = "/** \\} */ " $0 }
# The library's own parts are left out, and "Errors:  throws ..." begins a paragraph.
/^  \/\/\/? For the library's own parts/ { own = 1 }
/^ private:$/ { own = 0 }
/^ *\/\/\/ [A-Za-z]+: / { sub(/: */, ":} "); sub(/\/\/\/ /, "&\\part{") }
{ print own ? "" : $0 }

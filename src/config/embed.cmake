# Writes every file of FILES (relative to ROOT) into OUTPUT as a table of names and contents.
string(REPLACE " " ";" FILES "${FILES}")
set(text "#include \"src/config/embedded.hpp\"\n\nnamespace hogline::config {\n\nstd::span<const EmbeddedFile> embedded_files() {\n  static constexpr EmbeddedFile files[] = {\n")
foreach(name IN LISTS FILES)
  file(READ ${ROOT}/${name} content)
  string(APPEND text "      {\"${name}\", R\"hogline(${content})hogline\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n\n}  // namespace hogline::config\n")
file(WRITE ${OUTPUT} "${text}")

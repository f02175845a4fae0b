# Writes a source that holds the text of files: of each, a std::string_view in namespace
# grainsweep::templates, named after the file without its dots.
# usage: cmake -D SOURCE=<to write> -D FILES=<a,b,c> -P embed.cmake
string(REPLACE "," ";" files "${FILES}")
set(text "#include \"runner/report/templates.hpp\"\n\nnamespace grainsweep::templates {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} content)
  string(APPEND text "\nconst std::string_view ${name} = R\"grainsweep(${content})grainsweep\";\n")
endforeach()
file(WRITE ${SOURCE} "${text}\n}  // namespace grainsweep::templates\n")

# FOLDER/NAME.mustache and FOLDER/NAME.css as C++, a map by their names in a namespace:
# cmake -D FOLDER=... -D NAMESPACE=... -D OUT=... -P templates.cmake
file(GLOB files ${FOLDER}/*.mustache ${FOLDER}/*.css)
set(text "#include <map>\n#include <string>\n\nnamespace ${NAMESPACE}\n{\n")
string(APPEND text "const std::map<std::string, std::string> &templates()\n{\n")
string(APPEND text "static const std::map<std::string, std::string> all = {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} content)
  string(APPEND text "{\"${name}\", R\"template(${content})template\"},\n")
endforeach()
file(WRITE ${OUT} "${text}};\nreturn all;\n}\n}\n")

# Writes the source that tells the program its commit, anew only if that has changed.
# usage: cmake -D FOLDER=<of the project> -D SOURCE=<to write> -P source_commit.cmake
execute_process(COMMAND git -C ${FOLDER} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
set(text "#include \"runner/versions.hpp\"\n
std::string grainsweep::source_commit() { return \"${commit}\"; }\n")
if(EXISTS ${SOURCE})
  file(READ ${SOURCE} present)
endif()
if(NOT "${present}" STREQUAL "${text}")
  file(WRITE ${SOURCE} "${text}")
endif()

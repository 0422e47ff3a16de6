# Writes OUTPUT with the version and git revision of SOURCE, if they changed.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=10 HEAD
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
                OUTPUT_VARIABLE changes ERROR_QUIET)
if(changes)
  string(APPEND revision "+")
endif()
set(text "#include \"app/revision.hpp\"\n\nnamespace gannet {\n\n")
string(APPEND text "const char* version() { return \"${VERSION}\"; }\n")
string(APPEND text "const char* revision() { return \"${revision}\"; }\n\n}  // namespace gannet\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()

# Writes SOURCE with the commit of the checkout in FOLDER, and only where it is another one than before:
# run in every build, it makes one file be compiled anew, and only after a commit.
set(commit unknown)
find_package(Git QUIET)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${FOLDER} rev-parse --show-prefix OUTPUT_VARIABLE below
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE problem)
  if(NOT problem AND below STREQUAL "")  # not in a checkout of something else
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${FOLDER} describe --always --dirty --abbrev=12 --exclude=*
      OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE problem)
    if(NOT problem)
      set(commit ${described})
    endif()
  endif()
endif()
set(text "namespace saca::app {\nconst char* built_from();\nconst char* built_from() {\n  return \"${commit}\";\n}\n}\n")
set(before "")
if(EXISTS ${SOURCE})
  file(READ ${SOURCE} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${SOURCE} "${text}")
endif()

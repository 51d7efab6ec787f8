# Flags of this project's own targets. PRIVATE, so they never reach those who link to saca.
add_library(saca_flags INTERFACE)
target_compile_options(saca_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion
  -Wno-missing-field-initializers  # a field with a default may be left out of {.a = 1}
  $<$<BOOL:${SACA_DEVELOPER}>:-Werror>)

# Flags of the tests' own code: under a sanitiser it is compiled as it stands, in half the time; what is
# tested is not.
add_library(saca_test_flags INTERFACE)
target_compile_options(saca_test_flags INTERFACE $<$<CONFIG:Debug>:-O0>)
target_link_libraries(saca_test_flags INTERFACE saca_flags)

# All modules' tests, without benchmarks and programs.
add_custom_target(module_tests)

# saca_test(<target> <a.cpp>... LIBRARIES <library>...): a GoogleTest program with this project's
# flags and precompiled headers (tests/support).
function(saca_test target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES")
  add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} saca_test_flags GTest::gmock_main)
  target_precompile_headers(${target} REUSE_FROM saca_test_headers)
endfunction()

# saca_module(<name> [NOT_INSTALLED] [SOURCES <a.cpp>...] [DEPS <module>...])
#
# Makes the library saca::<name> from the current folder. Every <a>_test.cpp in the folder becomes
# the test <name>.<a>; a source without one stops the configuration. Every <a>_bench.cpp becomes a
# benchmark, run for an instant as a test so that it cannot rot. One more test checks that the folder
# includes only the modules in DEPS. Tests run in the project's folder.
function(saca_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NOT_INSTALLED" "" "SOURCES;DEPS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "saca_module(${name}): what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()

  foreach(module IN LISTS arg_DEPS)
    if(NOT TARGET saca::${module})
      message(FATAL_ERROR "saca_module(${name}): ${module} stands below it, or is no module")
    endif()
  endforeach()

  add_library(saca_${name} STATIC ${arg_SOURCES})
  add_library(saca::${name} ALIAS saca_${name})
  target_include_directories(saca_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
  target_compile_features(saca_${name} PUBLIC cxx_std_20)
  target_compile_options(saca_${name} PRIVATE -ffp-contract=off  # same bytes at every level
    -fno-math-errno -fno-trapping-math)  # changes no result: square roots and choices without branches
  list(TRANSFORM arg_DEPS PREPEND saca:: OUTPUT_VARIABLE libraries)
  target_link_libraries(saca_${name} PUBLIC ${libraries} PRIVATE $<BUILD_INTERFACE:saca_flags>)
  set_target_properties(saca_${name} PROPERTIES EXPORT_NAME ${name})
  if(NOT arg_NOT_INSTALLED)
    install(TARGETS saca_${name} EXPORT saca_targets)
    file(GLOB headers *.h)
    list(FILTER headers EXCLUDE REGEX "_(kernel|kernel_of|pack|handle)\\.h$")  # of kernels and of other libraries: not for others
    install(FILES ${headers} DESTINATION include/saca/${name})
  endif()
  if(NOT SACA_DEVELOPER)
    return()
  endif()

  foreach(source IN LISTS arg_SOURCES)
    cmake_path(GET source STEM stem)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${stem}_test.cpp)
      message(FATAL_ERROR "saca/${name}/${source} has no ${stem}_test.cpp beside it")
    endif()
  endforeach()

  file(GLOB tests CONFIGURE_DEPENDS *_test.cpp)
  foreach(test IN LISTS tests)
    cmake_path(GET test STEM stem)
    saca_test(${name}_${stem} ${test} LIBRARIES saca::${name})
    add_dependencies(module_tests ${name}_${stem})
    string(REPLACE _test "" unit ${stem})
    add_test(NAME ${name}.${unit} COMMAND ${name}_${stem} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name}.${unit} PROPERTIES LABELS ${name} TIMEOUT 300)
  endforeach()

  file(GLOB benches CONFIGURE_DEPENDS *_bench.cpp)
  foreach(bench IN LISTS benches)
    cmake_path(GET bench STEM stem)
    add_executable(${name}_${stem} ${bench})
    target_link_libraries(${name}_${stem} PRIVATE saca::${name} saca_flags benchmark::benchmark_main)
    add_test(NAME ${name}.${stem} COMMAND ${name}_${stem} --benchmark_min_time=0.001
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name}.${stem} PROPERTIES LABELS bench TIMEOUT 120)
  endforeach()

  list(JOIN arg_DEPS "," allowed)
  add_test(NAME ${name}.layers COMMAND ${CMAKE_COMMAND}
    -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR} -DALLOWED=${name},${allowed}
    -P ${PROJECT_SOURCE_DIR}/cmake/CheckLayers.cmake)
  set_tests_properties(${name}.layers PROPERTIES LABELS ${name})
endfunction()

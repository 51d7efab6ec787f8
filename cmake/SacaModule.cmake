# Flags of this project's own targets. PRIVATE, so they never reach those who link to saca.
add_library(saca_flags INTERFACE)
target_compile_options(saca_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion
  -Wno-missing-field-initializers  # a field with a default may be left out of {.a = 1}
  # GCC 12 warns of its own std::string (GCC bug 105651), and at -O3 of vectors in structs that it has itself
  # built in place: of the second kind nothing is left that would warn of a true case (decisions/0016).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-maybe-uninitialized>
  $<$<BOOL:${SACA_DEVELOPER}>:-Werror>)

# Flags of the tests' own code: it is compiled as it stands, in half the time; what is tested is not.
add_library(saca_test_flags INTERFACE)
target_compile_options(saca_test_flags INTERFACE -O0
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # for ccache
target_link_libraries(saca_test_flags INTERFACE saca_flags)

# Another build folder of the same sources. What only computes, or puts together what computes and tells of it
# (COMPUTES), is taken from there as it is, and so are the objects of tests: a sanitiser's build then takes a fifth
# of the time, and sees the code that reads what comes from outside, shares memory or begins processes.
set(SACA_TAKE_FROM "" CACHE PATH "A finished build folder to take computing modules and tests' objects from")

# All test programs, which `cmake --build --target tests` builds.
if(SACA_DEVELOPER)
  add_custom_target(tests)
endif()

# Far beyond what any test needs on a machine of its own: a busy one is slow, not broken.
set(SACA_TEST_TIMEOUT 3000)

# saca_test(<target> <a.cpp>... LIBRARIES <library>... [TAKEN <library>]): a GoogleTest program with this
# project's flags and precompiled headers (tests/support). TAKEN: its object may be taken from another
# build folder (SACA_TAKE_FROM), and this library comes before it.
function(saca_test target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TAKEN" "LIBRARIES")
  if(SACA_TAKE_FROM AND NOT SACA_THREAD_SANITISER AND arg_TAKEN)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_BINARY_DIR BASE_DIRECTORY ${PROJECT_BINARY_DIR} OUTPUT_VARIABLE folder)
    set(object ${SACA_TAKE_FROM}/${folder}/CMakeFiles/${target}.dir/Unity/unity_0_cxx.cxx.o)
    set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
    add_executable(${target} ${object})
    set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
    # Before the test's object: of functions that both hold, the first is linked, and that one is to be sanitised.
    target_link_options(${target} PRIVATE -Wl,--whole-archive $<TARGET_FILE:${arg_TAKEN}> -Wl,--no-whole-archive)
  else()
    add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
    target_precompile_headers(${target} REUSE_FROM saca_test_support)
  endif()
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} saca_test_support saca_test_flags)
  add_dependencies(tests ${target})
endfunction()

# saca_gtest(<test> <target> [<option>...]): runs a GoogleTest program in the project's folder. What is skipped is said.
function(saca_gtest test target)
  add_test(NAME ${test} COMMAND ${target} --gtest_brief=1 ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${test} PROPERTIES LABELS ${test} TIMEOUT ${SACA_TEST_TIMEOUT})
endfunction()

# saca_module(<name> [NOT_INSTALLED] [SOURCES <a.cpp>...] [DEPS <module>...] [TEST_DEPS <module>...]
#             [THREADS <filter>] [LONG <filter>] [ALONE <a_test.cpp>] [COMPUTES] [INNER_LOOPS])
#
# Makes the library saca::<name> from the current folder. All <a>_test.cpp in the folder become one
# program, <name>_test, and the test <name>, but one that asks for a process of its own (ALONE); a
# source without one stops the configuration. All <a>_bench.cpp become the program <name>_bench, run for an instant as a test so that it cannot rot.
# One more test checks that the folder includes only the modules in DEPS; tests may use those in TEST_DEPS, too,
# which may stand above. Tests run in the project's folder. Under the thread sanitiser there is only the test <name>.threads: those that match THREADS.
# LONG: tests that compute for long, or play whole encounters as others do, too; `asan-quick` leaves them out, `asan` does not.
# INNER_LOOPS: what all others spend their time in is optimised in a sanitiser's build, too.
#
# Files of tests are compiled together where builds are (CMAKE_UNITY_BUILD), so each has a namespace of
# its own: saca::<name>::<a>_test.
function(saca_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NOT_INSTALLED;COMPUTES;INNER_LOOPS" "THREADS;LONG;ALONE" "SOURCES;DEPS;TEST_DEPS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "saca_module(${name}): what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()

  foreach(module IN LISTS arg_DEPS)
    if(NOT TARGET saca::${module})
      message(FATAL_ERROR "saca_module(${name}): ${module} stands below it, or is no module")
    endif()
  endforeach()

  list(TRANSFORM arg_DEPS PREPEND saca:: OUTPUT_VARIABLE libraries)
  list(TRANSFORM arg_TEST_DEPS PREPEND saca:: OUTPUT_VARIABLE test_libraries)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
  set(taken FALSE)
  if(SACA_TAKE_FROM AND arg_COMPUTES)
    set(taken TRUE)
    set(arg_SOURCES ${PROJECT_SOURCE_DIR}/cmake/nothing.cpp)
  endif()
  add_library(saca_${name} STATIC ${arg_SOURCES})
  if(taken)
    add_library(saca_${name}_taken STATIC IMPORTED GLOBAL)
    set_target_properties(saca_${name}_taken PROPERTIES
      IMPORTED_LOCATION ${SACA_TAKE_FROM}/modules/${name}/libsaca_${name}.a
      INTERFACE_LINK_LIBRARIES "${libraries}")
    target_link_libraries(saca_${name} PUBLIC saca_${name}_taken)
  endif()
  add_library(saca::${name} ALIAS saca_${name})
  target_include_directories(saca_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
  target_compile_features(saca_${name} PUBLIC cxx_std_20)
  target_compile_options(saca_${name} PRIVATE -ffp-contract=off  # same bytes at every level
    -fno-math-errno -fno-trapping-math  # changes no result: square roots and choices without branches
    $<$<AND:$<BOOL:${arg_INNER_LOOPS}>,$<CONFIG:Debug>>:-O2>)
  target_link_libraries(saca_${name} PUBLIC ${libraries} PRIVATE $<BUILD_INTERFACE:saca_flags>)
  set_target_properties(saca_${name} PROPERTIES EXPORT_NAME ${name})
  if(NOT arg_NOT_INSTALLED)
    # What drives is a component of its own: it links to nothing but the C++ library (docs/architecture.md).
    if(folder MATCHES "^saca/(onboard/|base/(core|world)$)")
      set(component reflex)
    elseif(folder MATCHES "^saca/(base|thinking|runtime)")
      set(component runtime)
    else()
      set(component lab)
    endif()
    install(TARGETS saca_${name} EXPORT saca_${component}_targets)
    file(GLOB headers *.h)
    list(FILTER headers EXCLUDE REGEX "_(kernel|kernel_of|pack|handle|for_test)\\.h$")  # of kernels, other libraries and tests: not for others
    install(FILES ${headers} DESTINATION include/${folder})
  endif()
  if(NOT SACA_DEVELOPER OR taken)
    return()
  endif()

  foreach(source IN LISTS arg_SOURCES)
    cmake_path(GET source STEM stem)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${stem}_test.cpp)
      message(FATAL_ERROR "${folder}/${source} has no ${stem}_test.cpp beside it")
    endif()
  endforeach()

  file(GLOB tests CONFIGURE_DEPENDS *_test.cpp)
  if(arg_ALONE)
    list(REMOVE_ITEM tests ${CMAKE_CURRENT_SOURCE_DIR}/${arg_ALONE})
  endif()
  saca_test(${name}_test ${tests} LIBRARIES saca::${name} ${test_libraries} TAKEN saca_${name})
  if(SACA_THREAD_SANITISER)
    if(arg_THREADS)
      saca_gtest(${name}.threads ${name}_test --gtest_filter=${arg_THREADS})
    endif()
    return()
  endif()
  set(left_out)
  if(SACA_TAKE_FROM AND arg_LONG)
    set(left_out --gtest_filter=-${arg_LONG})
  endif()
  saca_gtest(${name} ${name}_test ${left_out})
  if(arg_ALONE)
    cmake_path(GET arg_ALONE STEM alone)
    saca_test(${name}_${alone} ${arg_ALONE} LIBRARIES saca::${name} ${test_libraries})
    saca_gtest(${name}.alone ${name}_${alone})
  endif()

  if(SACA_TAKE_FROM)
    return()
  endif()

  file(GLOB benches CONFIGURE_DEPENDS *_bench.cpp)
  if(benches AND NOT CMAKE_CROSSCOMPILING)
    add_executable(${name}_bench ${benches})
    target_link_libraries(${name}_bench PRIVATE saca::${name} ${test_libraries} saca_flags benchmark::benchmark_main)
    add_test(NAME ${name}.bench COMMAND ${name}_bench --benchmark_min_time=0.001
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name}.bench PROPERTIES LABELS bench TIMEOUT ${SACA_TEST_TIMEOUT})
  endif()

  list(JOIN arg_DEPS "," allowed)
  list(JOIN arg_TEST_DEPS "," in_tests)
  add_test(NAME ${name}.layers COMMAND ${CMAKE_COMMAND}
    -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR} -DALLOWED=${name},${allowed} -DIN_TESTS=${in_tests}
    -P ${PROJECT_SOURCE_DIR}/cmake/CheckLayers.cmake)
  set_tests_properties(${name}.layers PROPERTIES LABELS ${name})
endfunction()

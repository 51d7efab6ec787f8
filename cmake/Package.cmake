# What `cmake --install` leaves: libraries and headers that find_package(saca) finds, the program,
# and its data and scenarios in share/saca.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/saca)
set(saca_components reflex)
if(SACA_BUILD STREQUAL "lab")
  list(APPEND saca_components runtime lab)
endif()
foreach(component IN LISTS saca_components)
  install(EXPORT saca_${component}_targets NAMESPACE saca:: DESTINATION ${package})
endforeach()
set(SACA_DATA_FOLDER ${CMAKE_INSTALL_DATADIR}/saca)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/sacaConfig.cmake.in
  ${PROJECT_BINARY_DIR}/sacaConfig.cmake INSTALL_DESTINATION ${package} PATH_VARS SACA_DATA_FOLDER)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sacaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sacaConfig.cmake ${PROJECT_BINARY_DIR}/sacaConfigVersion.cmake
  DESTINATION ${package})
install(DIRECTORY data scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/saca)
install(FILES models/intent/model.safetensors DESTINATION ${CMAKE_INSTALL_DATADIR}/saca/models/intent)
install(FILES models/danger/compact_rwd_ev.safetensors DESTINATION ${CMAKE_INSTALL_DATADIR}/saca/models/danger)
install(FILES models/imitator/compact_rwd_ev.safetensors DESTINATION ${CMAKE_INSTALL_DATADIR}/saca/models/imitator)
install(FILES models/places/model.safetensors DESTINATION ${CMAKE_INSTALL_DATADIR}/saca/models/places)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/saca)

# `import ballbar`: the package of Python, in build/python, and installed where Debian's python3 looks for it.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)  # Debian's, for which its modules are
endif()
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED)
pybind11_add_module(ballbar_python NO_EXTRAS)
set(package ${PROJECT_BINARY_DIR}/python/ballbar)
set_target_properties(ballbar_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package})
target_compile_definitions(ballbar_python PRIVATE BALLBAR_VERSION="${PROJECT_VERSION}")
target_link_libraries(ballbar_python PRIVATE ballbar_commands glog::glog)
set(exports ${CMAKE_CURRENT_LIST_DIR}/exports.map)  # the module's start alone, so that no other library is bound to ours
target_link_options(ballbar_python PRIVATE -Wl,--version-script=${exports})
set_property(TARGET ballbar_python APPEND PROPERTY LINK_DEPENDS ${exports})
file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/ballbar/*.py ${CMAKE_CURRENT_LIST_DIR}/ballbar/*.pyi
  ${CMAKE_CURRENT_LIST_DIR}/ballbar/py.typed)
set(generated ${package}/_effects.py ${package}/_functions.py ${package}/_kinds.py)  # of what the program says
add_custom_command(OUTPUT ${generated} COMMAND ${CMAKE_COMMAND} -E make_directory ${package}
  COMMAND python_api effects ${package}/_effects.py COMMAND python_api functions ${package}/_functions.py
  COMMAND result_types python ${package}/_kinds.py DEPENDS python_api result_types VERBATIM)
add_custom_target(ballbar_python_files ALL COMMAND ${CMAKE_COMMAND} -E make_directory ${package}
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${sources} ${package} DEPENDS ${sources} ${generated} VERBATIM)
set(BALLBAR_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "where the package of Python is installed, below the prefix")
install(TARGETS ballbar_python DESTINATION ${BALLBAR_PYTHON_FOLDER}/ballbar COMPONENT python)
install(FILES ${sources} ${generated} DESTINATION ${BALLBAR_PYTHON_FOLDER}/ballbar COMPONENT python)

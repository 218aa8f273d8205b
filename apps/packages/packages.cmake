# The Debian packages, where BALLBAR_PACKAGES is ON: how the program is linked, what is installed with it, and what
# cpack makes of each component. apps/packages/make.sh builds them; README.md says what they hold.
set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE})  # Debian's, whatever the prefix of the build
include(GNUInstallDirs)
set(packages ${CMAKE_CURRENT_LIST_DIR})
file(STRINGS ${packages}/changelog first_line LIMIT_COUNT 1)
if(NOT first_line MATCHES "^ballbar \\(${PROJECT_VERSION}\\) ")
  message(FATAL_ERROR "apps/packages/changelog: expected the version ${PROJECT_VERSION} first, found: ${first_line}")
endif()

# Ceres and SuiteSparse name ATLAS beside BLAS: one of the two is enough, and BLAS is the smaller.
get_property(imported DIRECTORY PROPERTY IMPORTED_TARGETS)
foreach(target IN LISTS imported)
  get_target_property(linked ${target} INTERFACE_LINK_LIBRARIES)
  if(linked MATCHES "/lib(f77blas|atlas)\\.")
    list(FILTER linked EXCLUDE REGEX "/lib(f77blas|atlas)\\.")
    set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${linked}")
  endif()
endforeach()

# Only what is used, and nothing that can be written to once the program runs.
add_link_options(-Wl,--as-needed -Wl,--gc-sections -Wl,-z,relro -Wl,-z,now)

# OpenCV inside the program: as a shared library it brings OpenGL, with drivers and a compiler for them, of 220 MB. What
# of other libraries it then still asks for stands in opencv_inside.cpp, which goes wherever OpenCV does.
if(BALLBAR_IMAGES)
  find_library(OPENCV_CORE_INSIDE libopencv_core.a REQUIRED)
  find_library(OPENCV_IMGPROC_INSIDE libopencv_imgproc.a REQUIRED)
  add_library(ballbar_opencv_inside OBJECT ${packages}/opencv_inside.cpp)
  set_target_properties(ballbar_opencv_inside PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(ballbar_opencv_inside SYSTEM PRIVATE ${OPENCV_INCLUDE_DIR})
  target_link_libraries(ballbar_opencv_inside PRIVATE ballbar_build_flags)
  add_library(opencv_inside INTERFACE)
  target_link_libraries(opencv_inside INTERFACE $<TARGET_OBJECTS:ballbar_opencv_inside> ${OPENCV_IMGPROC_INSIDE}
    ${OPENCV_CORE_INSIDE} lapack blas z ${CMAKE_DL_LIBS})
  add_dependencies(opencv_inside ballbar_opencv_inside)
  set(OPENCV_IMGPROC opencv_inside)
  set(OPENCV_CORE opencv_inside)
endif()

# The desktop: a double click on a .b5r makes its page; in the menu where there is a tool to open without a file.
set(no_display true)
if(EXISTS ${PROJECT_SOURCE_DIR}/build-tool/ballbar.html)
  set(no_display false)
endif()
set(made ${PROJECT_BINARY_DIR}/packages)
configure_file(${packages}/ballbar.desktop.in ${made}/ballbar.desktop @ONLY)
install(PROGRAMS ${packages}/open.sh RENAME open DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/ballbar COMPONENT program)
install(FILES ${made}/ballbar.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
install(FILES ${packages}/ballbar.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT program)
foreach(place apps/ballbar mimetypes/application-x-ballbar-b5r)
  get_filename_component(folder ${place} DIRECTORY)
  get_filename_component(name ${place} NAME)
  install(FILES ${packages}/ballbar.svg RENAME ${name}.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/${folder} COMPONENT program)
endforeach()

# cpack packs what is built: it does not build the tests beside it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_THREADS 1)  # with several, the bytes of xz depend on how many
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "ballbar developers <ballbar@example.invalid>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has its own
set(CPACK_PRE_BUILD_SCRIPTS ${packages}/stage.cmake)
set(CPACK_BALLBAR_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_BALLBAR_BUILD ${PROJECT_BINARY_DIR})

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ballbar)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "xdg-utils, nodejs, python3-ballbar, libballbar-dev")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "turns ballbar logs of machine tools into errors and thermal drift
Reads the logs of ballbar tests of a machine tool (.b5r files, text, workbooks)
and gives the circle, the numbers of ISO 230-4 and the errors of the machine,
ranked by the circularity that each alone would make.

Of tests repeated while the spindle warms up it gives the thermal drift of the
spindle in micrometres, with its uncertainty, and says which physical effect a
model of that drift lacks, or that the data cannot tell. Results are tables,
JSON, and a page for the browser that needs no network.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libballbar-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libceres-dev, libeigen3-dev, libfmt-dev, libmuparser-dev, libpugixml-dev, libtomlplusplus-dev, nlohmann-json3-dev")
foreach(option_and_package IN ITEMS MAT=libmatio-dev XLSX=libzip-dev)
  string(REPLACE "=" ";" pair ${option_and_package})
  list(GET pair 0 option)
  list(GET pair 1 package)
  if(BALLBAR_${option})
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", ${package}")
  endif()
endforeach()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
  "ballbar, cmake, libopencv-imgproc-dev, libspng-dev, libjpeg62-turbo-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "ballbar logs of machine tools to thermal drift, C++ library
What the program ballbar does, as functions: circles and their uncertainty,
errors of a machine tool, thermal drift of the spindle, models of it as sums of
physical effects, and the diagnosis of what such a model lacks.

Headers, static libraries, and what find_package(ballbar) of CMake needs. The
component images needs the packages of OpenCV, libspng and libjpeg besides.")

# The module of Python, where it is built: it installs to lib/python3/dist-packages as the component python.
if(BALLBAR_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-ballbar)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-pandas")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "ballbar logs of machine tools to thermal drift, Python module
What the program ballbar does, from Python: circles and their uncertainty,
errors of a machine tool, thermal drift of the spindle, models of it and
what they lack, on files and on tables of pandas. With Dask it
keeps tables of the tests of many machines, on one computer or a cluster.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "ballbar, python3-distributed, python3-matplotlib, python3-sklearn, python3-tqdm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${packages}/postinst" "${packages}/prerm")
endif()
include(CPack)

# npm_packages(FOUND FROM TO [OPTION...]): the packages of FROM/package-lock.json in TO/node_modules, fetched while the
# build is configured, so that a build without them is one without what needs them. FOUND is whether they are there;
# TO/npm.log holds what npm said.
function(npm_packages found from to)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${from}/package-lock.json)
  file(READ ${from}/package-lock.json wanted)
  string(PREPEND wanted "npm ci ${ARGN}\n")
  set(installed "")
  if(EXISTS ${to}/installed)
    file(READ ${to}/installed installed)
  endif()
  set(failed 0)
  if(NOT installed STREQUAL wanted)
    file(REMOVE ${to}/installed)
    file(COPY ${from}/package.json ${from}/package-lock.json ${from}/.npmrc DESTINATION ${to})
    # A registry that does not answer is given up after two minutes, not after a quarter of an hour.
    execute_process(COMMAND ${BALLBAR_NPM} ci ${ARGN} --ignore-scripts --loglevel=error --fetch-retries=1
      --fetch-retry-mintimeout=1000 --fetch-timeout=60000 WORKING_DIRECTORY ${to} RESULT_VARIABLE failed
      OUTPUT_FILE ${to}/npm.log ERROR_FILE ${to}/npm.log)
    if(NOT failed)
      file(WRITE ${to}/installed "${wanted}")
    endif()
  endif()
  if(failed)
    set(${found} OFF PARENT_SCOPE)
  else()
    set(${found} ON PARENT_SCOPE)
  endif()
endfunction()

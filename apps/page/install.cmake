# cmake -D NPM=npm -D CHECKED=ON -P install.cmake: the chart library and what bundles the page, as the lock file has them;
# with CHECKED also what checks its types.
set(left_out --omit=dev)
if(CHECKED)
  set(left_out "")
endif()
execute_process(COMMAND ${NPM} ci ${left_out} --ignore-scripts --loglevel=error RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "npm could not install what the page of `ballbar report` is made with (above it says why). "
    "Without a network, build ballbar without its page: cmake -S . -B build -DBALLBAR_PAGE=OFF")
endif()

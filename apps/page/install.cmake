# cmake -D NPM=npm -P install.cmake: the chart library and the tools that check and bundle the page, as the lock file
# has them.
execute_process(COMMAND ${NPM} ci --ignore-scripts --loglevel=error RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "npm could not install what the page of `ballbar report` is made with (above it says why). "
    "Without a network, build ballbar without its page: cmake -S . -B build -DBALLBAR_PAGE=OFF")
endif()

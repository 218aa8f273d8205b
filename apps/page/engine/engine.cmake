# `ballbar` as a module for a page: build-tool.sh. libballbar is compiled for speed (for size, a diagnosis takes seventy
# times as long), what reads and prints for size.
find_library(ZLIB_OF_ZIP z REQUIRED)
target_link_libraries(ballbar PRIVATE ${ZLIB_OF_ZIP})
set_target_properties(ballbar PROPERTIES OUTPUT_NAME engine SUFFIX .js)
target_link_options(ballbar PRIVATE -fwasm-exceptions -O2 --no-entry
  -sMODULARIZE=1 -sEXPORT_NAME=ballbar_engine -sENVIRONMENT=worker,node -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB
  -sINITIAL_MEMORY=64MB -sTOTAL_STACK=8MB -sFORCE_FILESYSTEM=1 -sDYNAMIC_EXECUTION=0 -sEXIT_RUNTIME=0 -sINVOKE_RUN=0
  -sEXPORTED_RUNTIME_METHODS=FS,ccall)

# Run by cpack between the installation into its own folder and the packing.
execute_process(COMMAND sh ${CPACK_BALLBAR_SOURCE}/apps/packages/stage.sh ${CPACK_TEMPORARY_INSTALL_DIRECTORY}
    ${CPACK_BALLBAR_BUILD} ${CPACK_PACKAGE_VERSION}
  COMMAND_ERROR_IS_FATAL ANY)

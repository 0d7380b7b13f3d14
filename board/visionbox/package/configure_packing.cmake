# Read by cpack before it packs: the time that all files bear, and what the programs need.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(
    COMMAND git --no-optional-locks -C ${CPACK_TUBESIGHT_SOURCE} log -1 --format=%ct
    OUTPUT_VARIABLE epoch OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "package: not a checkout with git; set SOURCE_DATE_EPOCH, the time that the "
      "package's files bear, in seconds since 1970")
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${epoch})
endif()

execute_process(
  COMMAND ${CPACK_TUBESIGHT_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/dependencies.py
    --readelf ${CPACK_TUBESIGHT_READELF} --sysroot "${CPACK_TUBESIGHT_SYSROOT}"
    ${CPACK_TUBESIGHT_BUILD}/bin/tubesight ${CPACK_TUBESIGHT_BUILD}/bin/tubesightctl
    ${CPACK_TUBESIGHT_BUILD}/bin/tubesightd
  OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_DEPENDS
  OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
# The user is made by systemd-sysusers, the service enabled by init-system-helpers.
string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", init-system-helpers (>= 1.54), systemd")

# Run by cpack when everything is installed and before it is packed: adds what a package has beside, and
# puts manual pages and changelog into the form that Debian wants.
set(here ${CMAKE_CURRENT_LIST_DIR})
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
set(documents ${root}/usr/share/doc/tubesight)

file(COPY ${here}/box.toml DESTINATION ${root}/etc/tubesight)
file(COPY ${here}/copyright DESTINATION ${documents})
file(REMOVE ${documents}/LICENSE)  # copyright says where Debian has it
file(COPY_FILE ${here}/changelog ${documents}/changelog)

file(GLOB pages ${root}/usr/share/man/man1/*.1)
execute_process(
  COMMAND gzip -9n ${pages} ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)

execute_process(
  COMMAND ${CPACK_TUBESIGHT_PYTHON} -B ${here}/symbols.py
    --version ${CPACK_PACKAGE_VERSION} --architecture ${CPACK_DEBIAN_PACKAGE_ARCHITECTURE}
    --objcopy ${CPACK_TUBESIGHT_OBJCOPY} --readelf ${CPACK_TUBESIGHT_READELF}
    --root ${root} --out ${CPACK_PACKAGE_DIRECTORY}
    --compression ${CPACK_DEBIAN_COMPRESSION_TYPE}
  COMMAND_ERROR_IS_FATAL ANY)

# Of the programs as they are packed.
execute_process(
  COMMAND ${CPACK_TUBESIGHT_PYTHON} -B ${here}/bill_of_materials.py
    --version ${CPACK_PACKAGE_VERSION} --architecture ${CPACK_DEBIAN_PACKAGE_ARCHITECTURE}
    --sysroot "${CPACK_TUBESIGHT_SYSROOT}" --source ${CPACK_TUBESIGHT_SOURCE}
    --root ${root} --out ${documents}/tubesight.spdx.json
  COMMAND_ERROR_IS_FATAL ANY)

# Whatever the umask of whoever packs.
execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)

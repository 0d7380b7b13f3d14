# The Debian package: `cpack` in a build folder writes tubesight_VERSION_ARCHITECTURE.deb, and beside it
# one with the debug symbols. ../package.sh builds it for a board from a clean checkout.
#
# What `cmake --install` installs goes in, and what a package has beside: settings, the user, rules for
# devices, copyright, changelog, and the bill of materials. Files bear the time of the last commit, or
# SOURCE_DATE_EPOCH, so that two builds of one commit are the same to the byte.
set(here ${CMAKE_CURRENT_LIST_DIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tubesight)
set(CPACK_PACKAGE_VENDOR "Tubesight engineers")
set(CPACK_PACKAGE_CONTACT "Tubesight engineers <box@tubesight.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "vision box of a steam-generator servicing robot")
set(CPACK_PACKAGE_DESCRIPTION
"Looks through the camera of a robot's tool at a tubesheet, tracks the open
tube-ends, and tells the robot which tube its guidetube is under, whether that
is the tube the robot believes, and where the tool is.

The package has the box as a service (tubesightd), the program that asks it
(tubesightctl), and the one for calibration, recordings and simulation
(tubesight).")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES OFF)  # symbols.py does
set(CPACK_THREADS 1)        # compressed in blocks, a package would depend on the number of processors

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${here}/conffiles ${here}/postinst ${here}/prerm ${here}/postrm)
# Whose cameras of GigE Vision and USB3 Vision are loaded when one is opened.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libaravis-0.8-0")
# Reads videos and encodes overlays on a PC; no board needs it.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg")

set(architecture_of_aarch64 arm64)
set(architecture_of_arm armhf)
set(architecture_of_x86_64 amd64)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture_of_${CMAKE_SYSTEM_PROCESSOR}})

# Read by the two scripts.
set(CPACK_TUBESIGHT_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_TUBESIGHT_BUILD ${PROJECT_BINARY_DIR})
set(CPACK_TUBESIGHT_SYSROOT ${CMAKE_FIND_ROOT_PATH})
set(CPACK_TUBESIGHT_OBJCOPY ${CMAKE_OBJCOPY})
set(CPACK_TUBESIGHT_READELF ${CMAKE_READELF})
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
set(CPACK_TUBESIGHT_PYTHON ${Python3_EXECUTABLE})
set(CPACK_PROJECT_CONFIG_FILE ${here}/configure_packing.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${here}/before_packing.cmake)
include(CPack)

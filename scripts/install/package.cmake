# Packages for Debian and Ubuntu, `cpack -G DEB`: seismpm, and libseismpm-dev for those who build on the library. They need
# the libraries of the system that they are made on. scripts/package makes them for any processor.
set(SEISMPM_PACKAGE_BUILDS "" CACHE STRING "Folders of builds for other instructions, whose programs the package holds too (scripts/package)")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "seismpm <seismpm@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_PROGRAMS programs) # all that is taken of the builds for other instructions
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};seismpm;ALL;/")
foreach(build IN LISTS SEISMPM_PACKAGE_BUILDS)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${build};seismpm;programs;/")
endforeach()

# Programs and what is around them are one package, the library another.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL runtime development)
if(SEISMPM_LAUNCHER)
  list(APPEND CPACK_COMPONENTS_ALL programs)
endif()

cmake_host_system_information(RESULT system QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~${system_ID}${system_VERSION_ID}")
set(CPACK_DEBIAN_SEISMPM_PACKAGE_NAME seismpm)
set(CPACK_DEBIAN_SEISMPM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SEISMPM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SEISMPM_PACKAGE_RECOMMENDS "python3-numpy, python3-h5py, python3-scipy, python3-matplotlib, python3-yaml")
set(CPACK_DEBIAN_SEISMPM_PACKAGE_SUGGESTS "bash-completion, ffmpeg, paraview, python3-ezdxf, slurm-client")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libseismpm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libhdf5-dev, libyaml-cpp-dev, libcli11-dev, libfmt-dev, libspdlog-dev, nlohmann-json3-dev, libssl-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "The library of seismpm and its headers, for find_package(seismpm) of CMake.")
set(CPACK_DEBIAN_SEISMPM_DESCRIPTION "Computes how a slope fails in an earthquake and how far the slide runs, by an explicit\nmaterial point method in plane strain: programs, scripts, cases, documentation.")

include(CPack)
include(CPackComponent)
cpack_add_component_group(seismpm)
cpack_add_component(runtime GROUP seismpm)
cpack_add_component(programs GROUP seismpm)
cpack_add_component_group(development)
cpack_add_component(development GROUP development)

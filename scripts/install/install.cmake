# What `cmake --install` puts where. Nothing in it holds an absolute path: the folder may be moved.
#   bin                         the programs, and seismpm, which starts the scripts
#   share/seismpm               scripts and cases, beside each other as in the tree
#   share/doc, share/man, ...   pages, man pages, completion of the shells
#   include, lib                the library for find_package(seismpm); component `development`

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
set(data ${CMAKE_INSTALL_DATADIR}/seismpm)

# Programs. A package holds each for several sets of instructions, and bin what starts the best of them.
set(SEISMPM_LAUNCHER OFF CACHE BOOL "Install programs to lib/seismpm/ARCH, and to bin what chooses among them (scripts/package)")
set(programs mpm-static mpm-seismic)
if(SEISMPM_TESTS)
  list(APPEND programs seismpm-verify)
endif()
if(SEISMPM_LAUNCHER)
  install(TARGETS ${programs} DESTINATION lib/seismpm/${SEISMPM_ARCH} COMPONENT programs)
  add_executable(launcher solver/stages/launcher.cpp)
  foreach(program IN LISTS programs)
    install(PROGRAMS $<TARGET_FILE:launcher> DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME ${program})
  endforeach()
else()
  install(TARGETS ${programs} DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# Scripts, but those that build, test or serve the tree; and the one command that starts them.
file(GLOB scripts CONFIGURE_DEPENDS scripts/[a-z]*)
list(FILTER scripts EXCLUDE REGEX "/(install|install-packages|package|slurm|test|bench|verify|make_motion\\.py|plot_verification\\.py)$")
foreach(script IN LISTS scripts)
  if(script MATCHES "/[a-z-]+$")
    install(PROGRAMS ${script} DESTINATION ${data}/scripts)
  else()
    install(FILES ${script} DESTINATION ${data}/scripts)
  endif()
endforeach()
install(PROGRAMS scripts/slurm/job.sbatch DESTINATION ${data}/scripts/slurm)

# A link DESTINATION/NAME to TARGET, both within what is installed.
function(install_link destination name target)
  file(RELATIVE_PATH to /${destination} /${target})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links/${destination})
  file(CREATE_LINK ${to} ${PROJECT_BINARY_DIR}/links/${destination}/${name} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/links/${destination}/${name} DESTINATION ${destination})
endfunction()
install_link(${CMAKE_INSTALL_BINDIR} seismpm ${data}/scripts/seismpm)

# The JSON Schema of a case.
set(schema ${PROJECT_BINARY_DIR}/case.schema.json)
add_custom_command(OUTPUT ${schema} COMMAND mpm-static --schema > ${schema} DEPENDS mpm-static VERBATIM)
add_custom_target(schema ALL DEPENDS ${schema})
install(FILES ${schema} DESTINATION ${data})

# Cases, and all pages where their links lead to each other.
install(DIRECTORY cases DESTINATION ${data} PATTERN records EXCLUDE)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY boundaries io materials scripts solver test DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN *.md PATTERN *.png)
install_link(${CMAKE_INSTALL_DOCDIR} cases ${data}/cases)

# Man pages are what the programs and the commands of seismpm say of themselves: NAME.1, and seismpm-COMMAND.1.
set(documented ${programs} seismpm)
set(commands ${PROJECT_BINARY_DIR}/scripts)
add_custom_command(OUTPUT ${commands}/seismpm COMMAND ${CMAKE_COMMAND} -E make_directory ${commands}
  COMMAND ${CMAKE_COMMAND} -E copy ${scripts} ${commands} DEPENDS ${scripts} VERBATIM)
function(man_page name program command)
  set(page ${PROJECT_BINARY_DIR}/man/${name}.1)
  add_custom_command(OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=${program} -DCOMMAND=${command} -DPAGE=${page} -DVERSION=${PROJECT_VERSION}
      -DCODES=${PROJECT_SOURCE_DIR}/io/run_folder/README.md -P ${PROJECT_SOURCE_DIR}/scripts/install/man_page.cmake
    DEPENDS ${ARGN} ${commands}/seismpm ${PROJECT_SOURCE_DIR}/scripts/install/man_page.cmake io/run_folder/README.md
    VERBATIM)
  set(pages ${pages} ${page} PARENT_SCOPE)
endfunction()
foreach(program IN LISTS programs)
  man_page(${program} $<TARGET_FILE:${program}> "" ${program})
endforeach()
man_page(seismpm ${commands}/seismpm "") # which tells the commands beside it
foreach(script IN LISTS scripts)
  if(script MATCHES "/([a-z-]+)$" AND NOT script MATCHES "/(seismpm|find-[a-z]+)$")
    string(REGEX REPLACE ".*/" "" command ${script})
    man_page(seismpm-${command} ${commands}/seismpm ${command})
  endif()
endforeach()
add_custom_target(man-pages ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# Completion. The shells ask the programs what may follow.
foreach(program IN LISTS documented)
  string(REPLACE - _ FUNCTION ${program})
  set(PROGRAM ${program})
  configure_file(scripts/install/completion.bash.in completion/${program} @ONLY)
  configure_file(scripts/install/completion.zsh.in completion/_${program} @ONLY)
  configure_file(scripts/install/completion.fish.in completion/${program}.fish @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/completion/${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${PROJECT_BINARY_DIR}/completion/_${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${PROJECT_BINARY_DIR}/completion/${program}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endforeach()

# The library.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/seismpm)
target_include_directories(seismpm PUBLIC "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/seismpm>")
target_link_libraries(seismpm PUBLIC "$<INSTALL_INTERFACE:hdf5::hdf5;hdf5::hdf5_hl>")
install(TARGETS seismpm EXPORT seismpm)
install(EXPORT seismpm NAMESPACE seismpm:: FILE seismpm-targets.cmake DESTINATION ${package})
install(DIRECTORY boundaries io materials solver DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seismpm FILES_MATCHING PATTERN *.hpp)
list(TRANSFORM libraries REPLACE "(.+)" "find_dependency(\\1)" OUTPUT_VARIABLE DEPENDENCIES)
list(JOIN DEPENDENCIES "\n" DEPENDENCIES)
configure_package_config_file(scripts/install/seismpm-config.cmake.in seismpm-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(seismpm-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/seismpm-config.cmake ${PROJECT_BINARY_DIR}/seismpm-config-version.cmake DESTINATION ${package})

include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

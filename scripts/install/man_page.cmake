# Makes the man page PAGE of PROGRAM from what it says with --help, and from the table of exit codes in the page CODES; with
# COMMAND of that command of seismpm, which PROGRAM is then. The text of a program is set by help2man, where there is one; that of
# a command, whose examples are lines as they are typed, stands as it is.
cmake_path(GET PAGE PARENT_PATH folder)
cmake_path(GET PAGE STEM name)
file(MAKE_DIRECTORY ${folder})
set(ENV{SEISMPM_PROGRAMS} .) # a script looks for their folder before it says anything
execute_process(COMMAND ${PROGRAM} ${COMMAND} --help OUTPUT_VARIABLE help ERROR_VARIABLE reason RESULT_VARIABLE failed)
if(failed AND NOT COMMAND)
  message(FATAL_ERROR "${PROGRAM} --help: ${reason}")
elseif(COMMAND)
  execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "\n  ${COMMAND} +([^\n]+)" title "${list}")
  set(title ${CMAKE_MATCH_1})
  if(failed) # programs can be built where scripts cannot run
    message(STATUS "${name}.1 has no options: ${reason}")
    set(help "${title}.\n\nseismpm ${COMMAND} --help tells its options.\n")
  endif()
else()
  string(REGEX MATCH "^[^\n]+" title "${help}")
  string(REGEX REPLACE "^[a-z-]+: |\\.$" "" title "${title}")
endif()

# | 64 | wrong command line | see `--help` |
file(READ ${CODES} codes)
string(REPLACE ";" "," codes "${codes}") # which would end an element of a list
string(REGEX MATCHALL "\n\\| [0-9]+ \\| [^|]+" rows "${codes}")
set(sections "[EXIT STATUS]\n")
foreach(row IN LISTS rows)
  string(REGEX MATCH "\n\\| ([0-9]+) \\| (.+)" row "${row}")
  string(APPEND sections ".TP\n${CMAKE_MATCH_1}\n${CMAKE_MATCH_2}\n")
endforeach()
string(APPEND sections "\n[SEE ALSO]\n.BR seismpm (1),\n.BR mpm-static (1),\n.BR mpm-seismic (1),\n.BR seismpm-verify (1)\n")

find_program(HELP2MAN help2man)
if(HELP2MAN AND NOT COMMAND)
  file(WRITE ${PAGE}.sections "${sections}")
  execute_process(COMMAND ${HELP2MAN} --no-info --section=1 --name=${title} --version-string=${VERSION} --source=seismpm
    --manual=seismpm --include=${PAGE}.sections --output=${PAGE} ${PROGRAM} COMMAND_ERROR_IS_FATAL ANY)
else()
  string(REGEX REPLACE "\\\\" "\\\\e" help "${help}")
  string(REPLACE "-" "\\-" help "${help}")
  string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" help "${help}")
  string(REGEX REPLACE "\\[([A-Z ]+)\\]\n" ".SH \"\\1\"\n" sections "${sections}")
  file(WRITE ${PAGE} ".TH ${name} 1 \"\" \"seismpm ${VERSION}\" seismpm\n.SH NAME\n${name} \\- ${title}\n.SH DESCRIPTION\n.nf\n${help}\n.fi\n${sections}")
endif()

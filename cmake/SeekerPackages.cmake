# What is installed where, and the Debian packages made of it: `./run package`. Manual pages and completions come from
# the programs' --help, so that the target package_files is built before `cpack`.
set(SEEKER_MAINTAINER "Seeker authors <seeker@example.org>" CACHE STRING "Who is named as maintainer of the packages")

# Packages hold absolute paths (/etc, /lib/systemd), which no prefix moves.
if(CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
  set(CMAKE_INSTALL_PREFIX /usr CACHE PATH "Install path prefix" FORCE)
endif()
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(made ${PROJECT_BINARY_DIR}/packaging)
file(MAKE_DIRECTORY ${made})
configure_file(${packaging}/debian/changelog.in ${made}/changelog @ONLY)
add_custom_target(package_files)

# seeker_zipped(SOURCE TARGET_FILE): without name and time, so that the same source gives the same bytes.
function(seeker_zipped source file)
  add_custom_command(OUTPUT ${file} COMMAND gzip -9nc ${source} > ${file} DEPENDS ${source} VERBATIM)
endfunction()

# seeker_packaged_program(COMPONENT PROGRAM [WRITES_COMPLETION]): the program with its manual page and its completion for
# bash. WRITES_COMPLETION: the program has the verb `completion`.
function(seeker_packaged_program component program)
  cmake_parse_arguments(ARG "WRITES_COMPLETION" "" "" ${ARGN})
  set(help ${made}/${program}.help)
  set(page ${made}/${program}.1)
  set(completion ${made}/${program}.bash)
  add_custom_command(OUTPUT ${help} COMMAND ${packaging}/help/collect.sh $<TARGET_FILE:${program}> > ${help}
                     DEPENDS ${program} ${packaging}/help/collect.sh VERBATIM)
  add_custom_command(OUTPUT ${page}
                     COMMAND awk -v program=${program} -v version=${PROJECT_VERSION} -f ${packaging}/help/man_page.awk
                             ${help} > ${page}
                     DEPENDS ${help} ${packaging}/help/man_page.awk VERBATIM)
  if(ARG_WRITES_COMPLETION)
    set(write_completion ${program} completion bash)
  else()
    set(write_completion awk -v program=${program} -f ${packaging}/help/completion.awk ${help})
  endif()
  add_custom_command(OUTPUT ${completion} COMMAND ${write_completion} > ${completion}
                     DEPENDS ${help} ${packaging}/help/completion.awk VERBATIM)
  seeker_zipped(${page} ${page}.gz)
  add_custom_target(package_files_${program} DEPENDS ${page}.gz ${completion})
  add_dependencies(package_files package_files_${program})
  install(TARGETS ${program} RUNTIME DESTINATION bin COMPONENT ${component})
  install(FILES ${page}.gz DESTINATION share/man/man1 COMPONENT ${component})
  install(FILES ${completion} DESTINATION share/bash-completion/completions RENAME ${program} COMPONENT ${component})
endfunction()

seeker_packaged_program(server seekerd)
seeker_packaged_program(server seeker-emulator)
seeker_packaged_program(client seeker WRITES_COMPLETION)
seeker_packaged_program(lab seeker-lab)

install(FILES ${packaging}/robot.yaml DESTINATION /etc/seeker COMPONENT server)
install(FILES ${packaging}/seekerd.service DESTINATION /lib/systemd/system COMPONENT server)
install(FILES ${packaging}/60-seeker.rules DESTINATION /lib/udev/rules.d COMPONENT server)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/config DESTINATION share/seeker COMPONENT data)
# With the folders of the tree, in which the links from page to page hold.
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION share/doc/seeker-doc COMPONENT doc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION share/doc/seeker-doc COMPONENT doc)

seeker_zipped(${made}/changelog ${made}/changelog.gz)
add_custom_target(package_files_changelog DEPENDS ${made}/changelog.gz)
add_dependencies(package_files package_files_changelog)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME seeker)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "The Seeker authors")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_COMPONENTS_ALL server client lab data doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${SEEKER_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# seeker_package(COMPONENT [ALL] SECTION S SUMMARY S TEXT T [DEPENDS D...] [RECOMMENDS R...] [CONTROL FILE...]):
# the package seeker-COMPONENT. ALL: it holds no programs. CONTROL: its files of packaging/debian, COMPONENT.NAME.
function(seeker_package component)
  cmake_parse_arguments(ARG "ALL" "SECTION;SUMMARY;TEXT" "DEPENDS;RECOMMENDS;CONTROL" ${ARGN})
  string(TOUPPER ${component} C)
  set(name seeker-${component})
  install(FILES ${packaging}/debian/copyright ${made}/changelog.gz DESTINATION share/doc/${name}
          COMPONENT ${component})
  set(control)
  foreach(file IN LISTS ARG_CONTROL)
    configure_file(${packaging}/debian/${component}.${file} ${made}/${component}/${file} COPYONLY)
    list(APPEND control ${made}/${component}/${file})
  endforeach()
  list(JOIN ARG_DEPENDS ", " depends)
  list(JOIN ARG_RECOMMENDS ", " recommends)
  set(prefix CPACK_DEBIAN_${C}_PACKAGE)
  set(${prefix}_NAME ${name} PARENT_SCOPE)
  set(${prefix}_SECTION ${ARG_SECTION} PARENT_SCOPE)
  set(${prefix}_DEPENDS "${depends}" PARENT_SCOPE)
  set(${prefix}_RECOMMENDS "${recommends}" PARENT_SCOPE)
  set(${prefix}_CONTROL_EXTRA "${control}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_DESCRIPTION "${ARG_SUMMARY}\n${ARG_TEXT}" PARENT_SCOPE)
  if(ARG_ALL)
    set(${prefix}_ARCHITECTURE all PARENT_SCOPE)
    set(${prefix}_SHLIBDEPS OFF PARENT_SCOPE)
  else()
    set(${prefix}_SHLIBDEPS ON PARENT_SCOPE)
  endif()
endfunction()

set(data "seeker-data (= ${PROJECT_VERSION})")
seeker_package(server SECTION misc SUMMARY "robot that searches unknown buildings (server)"
               DEPENDS adduser ${data} RECOMMENDS seeker-client CONTROL postinst prerm postrm conffiles TEXT
"Seeker goes into a building that nobody has mapped, searches it for a target
and reports where the target is, what was searched and which places were not
seen. This package holds seekerd, the server that runs on the robot, as a
systemd service that is not enabled before you do so, and seeker-emulator, a
simulated world for several of them.")
seeker_package(client SECTION misc SUMMARY "robot that searches unknown buildings (client)"
               DEPENDS fonts-dejavu-core ${data} TEXT
"Commands a robot that runs seekerd, from anywhere: starts searches and
explorations, shows what the robot does, draws maps and keeps them.")
seeker_package(lab SECTION science SUMMARY "robot that searches unknown buildings (experiments)"
               DEPENDS fonts-dejavu-core ${data} RECOMMENDS seeker-server seeker-client TEXT
"Experiments with the algorithms of Seeker in the simulator and over recorded
logs, without a network: SLAM, search, exploration, merging of maps,
calibration of cameras.")
seeker_package(data ALL SECTION misc SUMMARY "robot that searches unknown buildings (configuration)" TEXT
"Robot files, simulated worlds, targets and mission scripts, for the programs
of Seeker.")
seeker_package(doc ALL SECTION doc SUMMARY "robot that searches unknown buildings (documents)" TEXT
"How to set up a robot, a guide, architecture, algorithms, the protocol, and
what was measured.")

include(CPack)

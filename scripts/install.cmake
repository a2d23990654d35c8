# Destinations of all files of `cmake --install` and `cpack -G DEB`: programs, catalogue, pages, manuals, completions, licence.
set(programs dresslife dresslife-sim dresslife-strain dresslife-fatigue dresslife-import)

# Programs find the catalogue from their own folder, as bin/../share/dresslife/config (pipeline/base/installation.h).
get_filename_component(above_programs ${CMAKE_INSTALL_FULL_BINDIR} DIRECTORY)
if(NOT CMAKE_INSTALL_FULL_DATADIR STREQUAL "${above_programs}/share")
  message(FATAL_ERROR "CMAKE_INSTALL_DATADIR is ${CMAKE_INSTALL_FULL_DATADIR}, but programs in ${CMAKE_INSTALL_FULL_BINDIR} "
                      "look for their catalogue in ${above_programs}/share; leave CMAKE_INSTALL_BINDIR and CMAKE_INSTALL_DATADIR as they are")
endif()

# A build folder has the layout of an installation. The link is relative, so build folder and sources can be moved together.
set(shared ${CMAKE_BINARY_DIR}/share)
file(MAKE_DIRECTORY ${shared}/dresslife)
file(REAL_PATH ${shared}/dresslife link_folder)
file(REAL_PATH ${PROJECT_SOURCE_DIR}/config catalogue)
file(RELATIVE_PATH to_catalogue ${link_folder} ${catalogue})
file(CREATE_LINK ${to_catalogue} ${shared}/dresslife/config SYMBOLIC)

# Every build writes the commit to a separate file, so no program is linked again because of it.
add_custom_target(dresslife_commit ALL COMMAND ${PROJECT_SOURCE_DIR}/scripts/commit ${shared}/dresslife/commit
                  COMMENT "Looking up the commit" VERBATIM)
add_dependencies(dresslife dresslife_commit)

# Man pages and completions, which every program generates from its own options.
set(manuals)
foreach(program ${programs})
  set(ask --manual)
  if(program STREQUAL dresslife)
    set(ask manual)
  endif()
  set(man ${shared}/man/man1/${program}.1)
  set(bash ${shared}/bash-completion/completions/${program})
  set(zsh ${shared}/zsh/_${program})
  add_custom_command(OUTPUT ${man}.gz ${bash} ${zsh} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${shared}/man/man1 ${shared}/bash-completion/completions ${shared}/zsh
    COMMAND ${program} ${ask} man > ${man}
    COMMAND gzip -9nf ${man}
    COMMAND ${program} ${ask} bash > ${bash}
    COMMAND ${program} ${ask} zsh > ${zsh}
    DEPENDS ${program})
  list(APPEND manuals ${man}.gz ${bash} ${zsh})
  install(FILES ${man}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${bash} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  # Debian's zsh searches a separate folder for completions of packages.
  install(CODE "
    set(folder site-functions)
    if(CMAKE_INSTALL_PREFIX MATCHES [[/usr$]])
      set(folder vendor-completions)
    endif()
    file(INSTALL [[${zsh}]] DESTINATION \"\${CMAKE_INSTALL_PREFIX}/share/zsh/\${folder}\")")
endforeach()
add_custom_target(dresslife_manuals ALL DEPENDS ${manuals})

install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY config/ DESTINATION ${CMAKE_INSTALL_DATADIR}/dresslife/config)
install(FILES ${shared}/dresslife/commit DESTINATION ${CMAKE_INSTALL_DATADIR}/dresslife OPTIONAL)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)  # Debian's name for it
# HDF5 is linked into the programs, so its licence must be shipped with them.
install(FILES /usr/share/doc/libhdf5-dev/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright.hdf5 OPTIONAL)
# The pages keep their relative positions, so their links work.
file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} *.md)
file(GLOB_RECURSE inner_pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
     sim/*.md strain/*.md fatigue/*.md pipeline/*.md config/*.md config/*.png pipeline/*.png)
foreach(page ${pages} ${inner_pages})
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dresslife)
set(CPACK_PACKAGE_CONTACT "The dresslife authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "life of the cables that an industrial robot carries outside")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Predicts from a robot's programs when a wire in its dresspack breaks, which
one, where along the hose, and which motion does it: simulates the hose,
works out the strain of every wire, counts cycles and sums up damage.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "ninja-build")  # runs the stages of a study
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libjs-three")  # draws the 3D view of pages
include(CPack)

# What `cmake --install` and the package (cpack -G DEB) hold. The program stands in a folder of its own, beside what it
# loads on demand; bin/ has a link to it, which it reads to find them.
include(GNUInstallDirs)
set(own ${CMAKE_INSTALL_LIBDIR}/gambeson)
install(TARGETS gambeson RUNTIME DESTINATION ${own})
install(TARGETS gambeson_cad gambeson_film LIBRARY DESTINATION ${own})
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/installed)
file(RELATIVE_PATH from_bin /at/${CMAKE_INSTALL_BINDIR} /at/${own}/gambeson)
file(CREATE_LINK ${from_bin} ${PROJECT_BINARY_DIR}/installed/gambeson SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/installed/gambeson DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases/library ${PROJECT_SOURCE_DIR}/cases/tutorials DESTINATION ${CMAKE_INSTALL_DATADIR}/gambeson)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/cases/FIELDS.md
              ${PROJECT_SOURCE_DIR}/cases/copyright
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

# NVIDIA's runtime may not be handed on beside libraries under the GPL: no package where it is linked in.
if(NOT GAMBESON_CUDA)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "The Gambeson developers <gambeson@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "what a garment costs its wearer")
  set(CPACK_PACKAGE_DESCRIPTION
      "Gambeson dresses a digital human in cloth, lets it walk, climb stairs and take aim,\nand measures what the cloth does to the body: torques that it adds at joints,\npressure on the skin, stress in the fabric, in pictures, tables and one report.")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, libosmesa6")  # of pictures: loaded when one is taken
  include(CPack)
endif()

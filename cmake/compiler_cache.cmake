# Where ccache is installed, files that were compiled before are not compiled again, whatever became of the build folder.
# The sloppiness is what precompiled headers need; they are rebuilt when what they include changes.
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(MONOCULAR_EYE_HAND_CCACHE ccache)
  if(MONOCULAR_EYE_HAND_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${MONOCULAR_EYE_HAND_CCACHE})
  endif()
endif()

# Who may know whom: apps -> coupling -> { dem, fem }; only fem/dealii knows deal.II; dem knows no fem, fem knows no
# dem, nobody knows apps. Inside a package the folders are floors: a folder includes its own files, the package's
# loose files, and the folders that its line below names. No line names a folder that comes later, so there is no
# circle. Scans the #include lines of the sources.
#
# usage: cmake [-DROOT=FOLDER] -P include_rules.cmake
cmake_minimum_required(VERSION 3.25)
if(NOT ROOT)
  get_filename_component(ROOT ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
endif()
set(failures "")

function(includes_of file out)
  file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  list(TRANSFORM lines REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*)[>\"].*" "\\1")
  set(${out} "${lines}" PARENT_SCOPE)
endfunction()

# --- packages ---------------------------------------------------------------------------------
# An optional fourth argument is the folder to which it does not apply.
function(forbid folder pattern reason)
  file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cc)
  foreach(file ${files})
    includes_of(${file} includes)
    file(RELATIVE_PATH name ${ROOT} ${file})
    if(ARGC GREATER 3 AND name MATCHES "^${ARGV3}")
      continue()
    endif()
    foreach(include ${includes})
      if(include MATCHES "^(${pattern})")
        list(APPEND failures "${name}: ${include}: ${reason}")
      endif()
    endforeach()
  endforeach()
  set(failures "${failures}" PARENT_SCOPE)
endfunction()

forbid(dem "fem/|coupling/|apps/" "dem knows nobody")
forbid(dem "deal\\.II/|petsc" "dem is free of deal.II and PETSc")
forbid(fem "dem/|coupling/|apps/" "fem knows nobody")
forbid(fem "deal\\.II/|petsc" "deal.II belongs to fem/dealii, which is loaded when it is needed" "fem/dealii/")
forbid(apps "deal\\.II/|petsc" "deal.II belongs to fem/dealii, which is loaded when it is needed")
forbid(coupling "apps/" "nobody knows apps")
forbid(coupling "deal\\.II/|petsc" "coupling sees plain nodal arrays")
forbid(apps/view "fem/|coupling/" "mergel-view reads files only")

# --- floors: folder, then the folders that it may include ------------------------------------------
# A folder in braces stands for itself alone; `.` are the loose files of the package, the lowest floor.
set(dem_floors
    "math"
    "particles: math"
    "laws: math particles"
    "pairs: math particles laws"
    "walls: math particles laws pairs"
    "parallel: math particles"
    "assembly: math particles laws pairs walls parallel"
    "continuum: math particles laws pairs walls parallel assembly"
    "specimen: math particles laws pairs walls parallel assembly"
    "element: math particles laws pairs walls parallel assembly"
    "io/hdf5: math particles"
    "io: math particles laws pairs walls parallel assembly continuum specimen element io/hdf5"
    "io/state: math particles laws pairs walls parallel assembly specimen element io/hdf5 io")
set(fem_floors
    "solid"
    "solver: solid"
    "far_field: solid solver"
    "membrane"
    "dealii: solid far_field membrane")
set(apps_floors
    "case"
    "run: case"
    "help: case run"
    "laboratory: case"
    "specimen: case run"
    "coupled: case run specimen"
    "pile: case run specimen coupled"
    "element: case run laboratory specimen"
    "triaxial: case run specimen coupled element"
    "brazilian: case run specimen coupled"
    "bond: case run"
    "sample: case run specimen coupled pile element triaxial brazilian"
    "check: case run sample"
    "bench: case run"
    "info: case run pile element triaxial brazilian"
    "compare: case run laboratory"
    "view: case laboratory"
    "view/bond: case view"
    "view/laboratory: case laboratory view"
    "view/pile: case view view/laboratory")

# Loose files that stand above the folders: they see all of the package.
set(apps_top mergel.cc view/view.cc)

function(check_floors package floors top)
  set(known "")
  foreach(floor ${floors})
    string(REGEX MATCH "^[^:]*" folder "${floor}")
    string(REGEX REPLACE "^([^:]+)(: )?(.*)$" "\\3" below "${floor}")
    string(REPLACE " " ";" below "${below}")
    foreach(other ${below})
      if(NOT other IN_LIST known)
        list(APPEND failures "include_rules: ${package}/${folder} may not name ${other}, which is no lower floor")
      endif()
    endforeach()
    list(APPEND known ${folder})
    set(below_${folder} "${below}")
  endforeach()

  file(GLOB_RECURSE files RELATIVE ${ROOT}/${package} ${ROOT}/${package}/*.h ${ROOT}/${package}/*.cc)
  foreach(file ${files})
    if(file IN_LIST top)
      continue()
    endif()
    get_filename_component(folder "${file}" DIRECTORY)
    if(folder AND NOT folder IN_LIST known)
      list(APPEND failures "${package}/${file}: its folder has no line in tests/include_rules.cmake")
      continue()
    endif()
    includes_of(${ROOT}/${package}/${file} includes)
    list(FILTER includes INCLUDE REGEX "^${package}/")
    foreach(include ${includes})
      string(REGEX REPLACE "^${package}/" "" seen "${include}")
      get_filename_component(seen "${seen}" DIRECTORY)
      if(seen AND NOT seen STREQUAL "${folder}" AND NOT (folder AND seen IN_LIST below_${folder}))
        list(APPEND failures "${package}/${file}: ${include}: ${package}/${seen} is no lower floor")
      endif()
    endforeach()
  endforeach()
  set(failures "${failures}" PARENT_SCOPE)
endfunction()

check_floors(dem "${dem_floors}" "")
check_floors(fem "${fem_floors}" "")
check_floors(apps "${apps_floors}" "${apps_top}")

# --- sizes: a folder that outgrows this holds more than one idea ---------------------------------
function(at_most n folder recursive)
  file(${recursive} files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cc)
  list(LENGTH files count)
  if(count GREATER n)
    list(APPEND failures "${folder}: ${count} sources, at most ${n}")
    set(failures "${failures}" PARENT_SCOPE)
  endif()
endfunction()

foreach(package dem fem coupling apps)
  file(GLOB_RECURSE entries LIST_DIRECTORIES true RELATIVE ${ROOT} ${ROOT}/${package}/*)
  foreach(entry ${entries})
    if(IS_DIRECTORY ${ROOT}/${entry})
      at_most(40 ${entry} GLOB)
    endif()
  endforeach()
endforeach()
at_most(14 dem GLOB)
at_most(14 fem GLOB)
at_most(40 coupling GLOB)
at_most(6 apps GLOB)

if(failures)
  list(JOIN failures "\n" text)
  message(FATAL_ERROR "${text}")
endif()
message(STATUS "include rules hold")

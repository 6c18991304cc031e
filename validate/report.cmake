# SPDX-License-Identifier: Apache-2.0
# Reports and baselines; the scripts and styles of report.html are embedded when the program is
# built, dygraphs from Debian's package libjs-dygraphs.
find_package(ZLIB REQUIRED)
find_file(DYGRAPHS_SCRIPT dygraph.min.js PATHS /usr/share/javascript/dygraphs REQUIRED
  DOC "dygraph.min.js of Debian's package libjs-dygraphs")

# embed(NAME symbol FILES file...): a C source of the files, joined.
function(embed)
  cmake_parse_arguments(E "" "NAME" "FILES" ${ARGN})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${E_NAME}.c)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAME=${E_NAME} "-DFILES=${E_FILES}"
      -P ${CMAKE_CURRENT_SOURCE_DIR}/web/embed.cmake
    DEPENDS ${E_FILES} ${CMAKE_CURRENT_SOURCE_DIR}/web/embed.cmake VERBATIM)
  target_sources(validate_core PRIVATE ${out})
endfunction()

set(REPORT_SCRIPTS decode tables group plots bicycle replay downloads explorer main)
list(TRANSFORM REPORT_SCRIPTS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/web/)
list(TRANSFORM REPORT_SCRIPTS APPEND .js)
embed(NAME report_web_style FILES ${CMAKE_CURRENT_SOURCE_DIR}/web/page.css)
embed(NAME report_web_dygraphs FILES ${DYGRAPHS_SCRIPT})
embed(NAME report_web_script FILES ${REPORT_SCRIPTS})

target_sources(validate_core PRIVATE
  baseline.c
  baseline_floor.c
  baseline_print.c
  baseline_read.c
  report_counts.c
  report_csv.c
  report_curves.c
  report_curves_study.c
  report_html.c
  report_html_gates.c
  report_html_head.c
  report_html_origin.c
  report_html_scenario.c
  report_html_tree.c
  report_json.c
  report_json_layers.c
  report_junit.c
  report_markup.c
  report_pack.c
  report_plot.c
  report_print.c
  report_read.c
  report_series.c
  report_summary.c
  report_write.c)
target_link_libraries(validate_core PRIVATE ZLIB::ZLIB)
install(FILES schema/report.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/bicycle/schema)

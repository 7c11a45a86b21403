# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Converts pages in Markdown, and the images that they show, for ParaView's help:
#   cmake -DCMARK=<cmark-gfm> -DPAGES=<folder> -DOUTPUT=<folder> -P HelpPages.cmake
file(REMOVE_RECURSE "${OUTPUT}")
file(GLOB pages "${PAGES}/*.md")
foreach (page IN LISTS pages)
  execute_process(
    COMMAND "${CMARK}" --extension table "${page}"
    OUTPUT_VARIABLE text
    COMMAND_ERROR_IS_FATAL ANY)
  # Headings have the anchors that links name, as on GitHub.
  string(REGEX MATCHALL "<h[1-6]>[^\n;]*</h[1-6]>" headings "${text}")
  foreach (heading IN LISTS headings)
    string(REGEX REPLACE "<[^>]*>" "" anchor "${heading}")
    string(TOLOWER "${anchor}" anchor)
    string(REGEX REPLACE "[^a-z0-9 _-]" "" anchor "${anchor}")
    string(REPLACE " " "-" anchor "${anchor}")
    string(REGEX REPLACE "^<(h[1-6])>" "<\\1 id=\"${anchor}\">" with_anchor "${heading}")
    string(REPLACE "${heading}" "${with_anchor}" text "${text}")
  endforeach ()
  string(REGEX REPLACE "href=\"([a-z_]+)\\.md" "href=\"\\1.html" text "${text}")
  # What is not in the help is a text without a link.
  string(REGEX REPLACE "<a href=\"(\\.\\.|development|scripts)[^>]*>([^<]*(<code>[^<]*</code>)?[^<]*)</a>" "\\2" text "${text}")
  string(REGEX MATCHALL "images/[a-z_]+\\.[a-z]+" images "${text}")
  foreach (image IN LISTS images)
    file(COPY "${PAGES}/${image}" DESTINATION "${OUTPUT}/images")
  endforeach ()
  get_filename_component(name "${page}" NAME_WE)
  file(WRITE "${OUTPUT}/${name}.html"
    "<html><head><meta charset=\"utf-8\"/></head><body>\n${text}</body></html>\n")
endforeach ()

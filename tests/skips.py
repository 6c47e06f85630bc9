"""skips.py RESULTS.xml: a line for each test that ctest skipped, with the reason that the test printed.
Reads what `ctest --output-junit` wrote."""
import re
import sys
import xml.etree.ElementTree as xml

skipped = []
for case in xml.parse(sys.argv[1]).getroot().iter("testcase"):
    if case.find("skipped") is None:
        continue
    said = case.findtext("system-out") or ""
    # A script prints `skipped: WHY`; GoogleTest prints WHY in the line after `Skipped`.
    why = re.search(r"^(?:.*: )?skipped: (.*)$", said, re.M) or re.search(r"Skipped\n(.*)$", said, re.M)
    skipped.append(f"skipped: {case.get('name')}: {why.group(1) if why else 'it does not say why'}")
if skipped:
    print("\n".join(skipped))
    print(f"{len(skipped)} skipped; `./dev tools` installs what they need")

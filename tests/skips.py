"""skips.py RESULTS.xml: prints a line for each test skipped by ctest and each case skipped by GoogleTest, with the
reason. Reads the output of `ctest --output-junit`."""
import re
import sys
import xml.etree.ElementTree as xml

skipped = []
for case in xml.parse(sys.argv[1]).getroot().iter("testcase"):
    said = case.findtext("system-out") or ""
    # A script prints `skipped: WHY`; GoogleTest prints WHY in the line after `Skipped`.
    why = re.findall(r"Skipped\n(.*)$", said, re.M)
    if case.find("skipped") is not None:
        why += re.findall(r"^(?:.*: )?skipped: (.*)$", said, re.M)[:1] or ["it does not say why"]
    skipped += [f"skipped: {case.get('name')}: {reason}" for reason in why]
if skipped:
    print("\n".join(skipped))
    print(f"{len(skipped)} skipped; `./dev tools` installs what they need")

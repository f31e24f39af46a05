"""A worker that does what the question tells it: it crashes, sleeps, eats, talks too much."""

import json
import os
import sys
import time


def say(words: object) -> None:
    sys.stdout.write(json.dumps(words, separators=(",", ":")) + "\n")
    sys.stdout.flush()


def main() -> None:
    for line in sys.stdin:
        body = json.loads(line)["body"]
        match body.get("do"):
            case "crash":
                os.kill(os.getpid(), 11)
            case "sleep":
                time.sleep(body.get("for", 1e6))
            case "half":
                sys.stdout.write('{"answer":')
                sys.stdout.flush()
                os._exit(0)
            case "huge":
                say({"answer": "x" * body["size"]})
            case "talk":
                for number in range(body["lines"]):
                    say({"progress": {"number": number}})
                    time.sleep(body.get("pause", 0.0))
            case "repeat":
                pass
        say({"answer": {"pid": os.getpid()}})


if __name__ == "__main__":
    main()

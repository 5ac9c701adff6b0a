"""Everything that is wrong or odd about a scene's recipe, without rendering."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import partial

import bpy

from . import findings, row_states, running
from .child_verb import ChildVerb, Ended, is_under_way
from .reading import ReadingVerb
from .tell import tell


class RTB_OT_check_recipe(ReadingVerb, bpy.types.Operator):
    """Say everything that is wrong with the recipe, without rendering; each finding can be selected"""

    bl_idname = "rtb.check_recipe"
    bl_label = "Check"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        if busy := is_under_way("check"):
            cls.poll_message_set("The recipe is being checked")
        return not busy

    def refused(self, context, error):
        problems = scene_problems(context)
        findings.clear()
        # Whoever reads the scene stops at the first problem, and says that it cannot be written.
        said = str(error).replace(" cannot be written: ", ": ")
        told = any(each in said or said in each for each in problems)
        findings.note([*problems, *([] if told else [str(error)])])
        self.report({"WARNING"}, _counted(len(findings.errors)))
        return {"FINISHED"}

    def go_on(self, context, folder):
        findings.note(scene_problems(context))
        take = partial(_take, context.scene.session_uid, row_states.what_it_says(context.scene))
        ChildVerb(["check", str(folder), "--json"], take, of_file=True)
        if bpy.app.background:
            self.report({"INFO"}, _counted(len(findings.errors)))
        return {"FINISHED"}


def scene_problems(context) -> list[str]:
    """Return what is wrong with the scene before anything is written."""
    from ..rtb_addon.blender import scene_problems  # brings numpy, which enabling need not wait for

    return scene_problems.scene_problems(context.scene)


def _take(scene: int, said: Mapping[str, row_states.Said], ended: Ended) -> None:
    """Take in what the child has found of a scene as it was then."""
    found = [json.loads(line) for line in ended.lines if line.startswith("{")]
    findings.note(
        [each["sentence"] for each in found if each["problem"]]
        or (ended.complaints[-1:] if not found and ended.status else []),
        [each["sentence"] for each in found if not each["problem"] and "meaning" not in each],
    )
    done = [each["done"] for each in found if "done" in each]
    here = next((each for each in bpy.data.scenes if each.session_uid == scene), None)
    if done and here is not None and running.batch is None:  # a batch knows better
        row_states.settle(here, said, done[0])
    if not bpy.app.background:
        tell("WARNING" if findings.errors else "INFO", _counted(len(findings.errors)))


def _counted(count: int) -> str:
    if not count:
        return "Checked: the recipe can be rendered"
    return f"Checked: {count} problem{'s' * (count != 1)}, see the recipe's panel"

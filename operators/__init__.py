"""What the user can do: one verb a file."""

from bpy.utils import register_classes_factory

from . import call_tooltips, command, image_editor, preferences, render_engine, running, watching
from .add_condition import RTB_OT_add_condition
from .add_material_preset import RTB_OT_add_material_preset
from .add_variable import RTB_OT_add_variable
from .cancel_rendering import RTB_OT_cancel_rendering
from .check_recipe import RTB_OT_check_recipe
from .compare_renderers import RTB_OT_compare_renderers
from .copy_conditions import RTB_OT_copy_conditions
from .dropped_files import RTB_FH_recipe, RTB_FH_spectra
from .duplicate_condition import RTB_OT_duplicate_condition
from .duplicate_variable import RTB_OT_duplicate_variable
from .edit_mapping import RTB_OT_edit_mapping
from .edit_mapping_line import RTB_OT_edit_mapping_line
from .edit_mappings_text import RTB_OT_edit_mappings_text
from .export_conditions import RTB_OT_export_conditions
from .export_recipe import RTB_OT_export_recipe
from .fill_from_library import RTB_OT_fill_from_library
from .fill_graded import RTB_OT_fill_graded
from .fill_grid import RTB_OT_fill_grid
from .fill_list import RTB_OT_fill_list
from .fill_pairs import RTB_OT_fill_pairs
from .fill_random import RTB_OT_fill_random
from .fill_range import RTB_OT_fill_range
from .import_conditions import RTB_OT_import_conditions
from .import_recipe import RTB_OT_import_recipe
from .import_spectra import RTB_OT_import_spectra
from .move_condition import RTB_OT_move_condition
from .move_variable import RTB_OT_move_variable
from .open_folder import RTB_OT_open_folder
from .pack_recipe import RTB_OT_pack_recipe
from .paste_conditions import RTB_OT_paste_conditions
from .preferences import RTB_AP_preferences
from .preview_condition import RTB_OT_preview_condition
from .remove_condition import RTB_OT_remove_condition
from .remove_mapping import RTB_OT_remove_mapping
from .remove_mapping_line import RTB_OT_remove_mapping_line
from .remove_variable import RTB_OT_remove_variable
from .rename_variable import RTB_OT_rename_variable
from .render_condition import RTB_OT_render_condition
from .render_recipe import RTB_OT_render_recipe
from .select_culprit import RTB_OT_select_culprit
from .select_variable import RTB_OT_select_variable
from .set_variable_kind import RTB_OT_set_variable_kind
from .show_condition import RTB_OT_show_condition
from .show_montage import RTB_OT_show_montage
from .spectra_folders import RTB_OT_add_spectra_folder, RTB_OT_remove_spectra_folder, RTB_PG_spectra_folder
from .tell import RTB_OT_tell
from .test_renderers import RTB_OT_test_renderers
from .turn_page import RTB_OT_turn_page
from .use_colour import RTB_OT_use_colour
from .use_curve import RTB_OT_use_curve
from .use_flat_spectrum import RTB_OT_use_flat_spectrum
from .use_library_spectrum import RTB_OT_use_library_spectrum
from .use_metal import RTB_OT_use_metal
from .use_spectra import RTB_OT_use_spectra
from .use_spectrum_file import RTB_OT_use_spectrum_file
from .use_table import RTB_OT_use_table, RTB_PG_sample
from .use_temperature import RTB_OT_use_blackbody, RTB_OT_use_daylight
from .use_variable import RTB_OT_use_variable
from .vary_in_recipe import RTB_OT_vary_in_recipe
from .vary_property import RTB_OT_vary_property

CLASSES = (
    RTB_OT_export_recipe,
    RTB_OT_render_recipe,
    RTB_OT_cancel_rendering,
    RTB_OT_show_condition,
    RTB_OT_show_montage,
    RTB_OT_use_spectra,
    RTB_OT_tell,
    RTB_OT_use_library_spectrum,
    RTB_OT_use_spectrum_file,
    RTB_OT_use_flat_spectrum,
    RTB_OT_use_daylight,
    RTB_OT_use_blackbody,
    RTB_OT_use_colour,
    RTB_OT_use_metal,
    RTB_OT_add_material_preset,
    RTB_PG_sample,
    RTB_OT_import_spectra,
    RTB_FH_spectra,
    RTB_OT_use_table,
    RTB_OT_use_curve,
    RTB_OT_use_variable,
    RTB_OT_vary_in_recipe,
    RTB_OT_add_condition,
    RTB_OT_add_variable,
    RTB_OT_copy_conditions,
    RTB_OT_duplicate_condition,
    RTB_OT_duplicate_variable,
    RTB_OT_export_conditions,
    RTB_OT_fill_from_library,
    RTB_OT_fill_graded,
    RTB_OT_fill_grid,
    RTB_OT_fill_list,
    RTB_OT_fill_random,
    RTB_OT_fill_range,
    RTB_OT_import_conditions,
    RTB_OT_move_condition,
    RTB_OT_move_variable,
    RTB_OT_paste_conditions,
    RTB_OT_remove_condition,
    RTB_OT_remove_variable,
    RTB_OT_rename_variable,
    RTB_OT_select_variable,
    RTB_OT_turn_page,
    RTB_OT_check_recipe,
    RTB_OT_import_recipe,
    RTB_FH_recipe,
    RTB_OT_compare_renderers,
    RTB_OT_edit_mapping,
    RTB_OT_edit_mapping_line,
    RTB_OT_edit_mappings_text,
    RTB_OT_open_folder,
    RTB_OT_pack_recipe,
    RTB_OT_preview_condition,
    RTB_OT_remove_mapping,
    RTB_OT_remove_mapping_line,
    RTB_OT_render_condition,
    RTB_OT_select_culprit,
    RTB_OT_set_variable_kind,
    RTB_OT_fill_pairs,
    RTB_OT_test_renderers,
    RTB_OT_vary_property,
    RTB_PG_spectra_folder,
    RTB_OT_add_spectra_folder,
    RTB_OT_remove_spectra_folder,
    RTB_AP_preferences,
    *image_editor.CLASSES,
)

_register, _unregister = register_classes_factory(CLASSES)


def register() -> None:
    """Make the operators known to Blender."""
    call_tooltips.add_to(CLASSES)
    _register()
    preferences.offer_others()
    image_editor.register()
    running.register()
    render_engine.register()
    watching.register()
    command.register()


def unregister() -> None:
    """Stop what is rendering and take the operators back."""
    command.unregister()
    watching.unregister()
    render_engine.unregister()
    running.unregister()
    image_editor.unregister()
    _unregister()

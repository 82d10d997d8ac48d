(( $+functions[_tinta_models] )) ||
_tinta_models() {
    _alternative 'built-in:built-in model:(@models@)' 'files:model:_files'
}
(( $+functions[_tinta_presets] )) ||
_tinta_presets() {
    _alternative 'papers:constants of a paper:(@presets@)' 'files:preset:_files'
}

if exists('b:did_ftplugin')
  finish
endif
let b:did_ftplugin = 1
setlocal commentstring=#\ %s comments=:#
setlocal makeprg=orb\ check\ --format=gcc\ % errorformat=%f:%l:%c:\ %m
let b:undo_ftplugin = 'setlocal commentstring< comments< makeprg< errorformat<'
if has('nvim')
  lua require('orb').start()
endif
